// SPDX-License-Identifier: MIT
// JerkPlan: the feed plan with the jerk of every axis limited. It takes its cells from an acceleration-limited plan;
// the speeds of that plan are upper bounds.
//
//      b |    __/ \__         acceleration-limited: a kink is a jump of the acceleration
//        |   / .---. \        jerk-limited: lower; b and db/ds are continuous; at standstill a = 0;
//        |  /./     \.\       it ends at standstill at the end of the known path
//        |_//         \\_
//        +-----------------> s
#pragma once

#include "splinefeed/s3_feed_plan/acceleration/graded_feed.hpp"
#include "splinefeed/s3_feed_plan/jerk/jerk_change.hpp"
#include "splinefeed/s3_feed_plan/jerk/profile_state.hpp"
#include "splinefeed/s3_feed_plan/jerk/straight_leg.hpp"
#include "splinefeed/s3_feed_plan/jerk/window_plan.hpp"

namespace splinefeed {

/// What a plan that is made in R samples its motion in: double loses nothing that Fixed has.
template <Scalar S, Floating R>
using JerkSampled = std::conditional_t<std::same_as<R, double>, double, S>;

/// Stage 3b. The plan in the window always ends at standstill. Cost: a cell is planned about twice (LegPlan<R>). In
/// parts: a step of the search is at most LegPlan's most_work steps of the budget. A change of the
/// steering while the machine moves plans the path ahead two or three times (JerkChange).
template <Scalar S, Floating R>
class JerkPlan final : public SampledPlan<S, JerkSampled<S, R>> {
public:
    using X = JerkSampled<S, R>;

    static constexpr std::size_t smallest_window = 16;

    /// @pre storage has at least smallest_window cells, and is enough(); this also holds for all other functions
    JerkPlan(FeedPlan<S>& source, const MotionLimits<S>& limits, const JerkStorage<S, R>& storage) noexcept;

    using MotionPlan<S>::prepare;
    Pull prepare(UnderrunPolicy underrun, WorkBudget& work) noexcept override;
    bool plan_ahead(WorkBudget& work) noexcept override;
    [[nodiscard]] const Cell<S>& cell() const noexcept override { return window_.cell(0); }
    void advance() noexcept override;
    void rest_at(X fraction) noexcept override;
    Steered steer(const PlanState<X>& place, UnderrunPolicy underrun, WorkBudget& work) noexcept override;
    [[nodiscard]] bool standing() const noexcept override;
    void clear() noexcept override;

    /// How often a leg could not be planned as fast as possible. Such a leg is travelled more slowly, within all
    /// limits, or as an older plan says.
    [[nodiscard]] std::uint64_t slow_legs() const noexcept { return plan_.slow_legs(); }
    /// How many legs were planned, a leg that is planned again once more; without straight legs.
    [[nodiscard]] std::uint64_t searched_legs() const noexcept { return plan_.searched_legs(); }
    [[nodiscard]] std::uint64_t window_limited() const noexcept { return plan_.window_limited(); }

private:
    using SampledPlan<S, X>::profile_segment_;
    using MotionPlan<S>::steering_;

    /// To the latest change of the steering.
    enum class Answer : std::uint8_t {
        given,
        owed, ///< no motion was found, and none will be from where this profile segment starts
        due   ///< a search for one may begin
    };

    Pull fill(UnderrunPolicy underrun, WorkBudget& work) noexcept;
    Pull take(UnderrunPolicy underrun, WorkBudget& work) noexcept;
    [[nodiscard]] R wanted_sq(const Cell<S>& cell, S most_sq) const noexcept;
    void want() noexcept;
    Search answer(double from, const SpeedState& state, UnderrunPolicy underrun, WorkBudget& work) noexcept;
    bool change_line(double from, const SpeedState& state) noexcept;
    Search change_curve(double from, const SpeedState& state, WorkBudget& work) noexcept;
    bool follow_steering(UnderrunPolicy underrun, WorkBudget& work) noexcept;
    [[nodiscard]] bool go_on(UnderrunPolicy underrun) noexcept;
    void forward_step() noexcept;
    void forward_step_on_line() noexcept;

    GradedFeed<S> source_;
    const MotionLimits<S>* limits_;
    JerkWindow<S, R> window_;
    WindowPlan<S, R> plan_;
    JerkChange<S, R> change_;  // runs while a motion for a change of the steering is searched
    LineTravel line_{};        // used while a straight leg is travelled
    MoveLimits line_limits_{}; // limits of that leg
    std::size_t halt_ = 0;     // cells from the front on to the stop that a hold made; 0: none
    double on_line_mm_ = 0.0;  // part of the cell that is already travelled
    bool chosen_ = false;
    Answer answer_ = Answer::given;
};

} // namespace splinefeed
