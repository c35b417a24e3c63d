// SPDX-License-Identifier: MIT
// JerkPlan: the feed plan once more, with every axis's jerk limited. It takes its cells from an acceleration-limited
// plan, whose speeds bound its own.
//
//      b |    __/ \__         acceleration-limited: kinks are jumps of the acceleration
//        |   / .---. \        jerk-limited: below, b and db/ds continuous, at rest with a = 0,
//        |  /./     \.\       and at rest at the end of what is known
//        |_//         \\_
//        +-----------------> s
#pragma once

#include "splinefeed/s3_feed_plan/acceleration/graded_feed.hpp"
#include "splinefeed/s3_feed_plan/jerk_optimal/jerk_change.hpp"
#include "splinefeed/s3_feed_plan/jerk_optimal/profile_state.hpp"
#include "splinefeed/s3_feed_plan/jerk_optimal/straight_leg.hpp"

namespace splinefeed {

/// Stage 3b. What is planned in the window always ends at rest. Cost: a cell is planned about twice (JerkLeg::plan); a
/// change of the steering while the machine moves plans what lies ahead about twelve times (JerkChange).
template <Scalar S>
class JerkPlan final : public MotionPlan<S> {
public:
    static constexpr std::size_t smallest_window = 16;

    /// Less storage than smallest_window and nodes_for() it is a broken precondition of all that follows.
    JerkPlan(FeedPlan<S>& source, const MotionLimits<S>& limits, const JerkStorage<S>& storage) noexcept;

    Pull prepare(UnderrunPolicy underrun = UnderrunPolicy::wait) noexcept override;
    [[nodiscard]] const Cell<S>& cell() const noexcept override { return window_.cell(0); }
    void advance() noexcept override;
    void rest_at(S fraction) noexcept override;
    bool steer(const Place<S>& place) noexcept override;
    [[nodiscard]] bool standing() const noexcept override;
    void clear() noexcept override;

    /// How often a leg could not be planned as fast as it should be: it is travelled slower, within all limits.
    [[nodiscard]] std::uint64_t slow_legs() const noexcept { return slow_legs_; }

private:
    using MotionPlan<S>::profile_segment_;
    using MotionPlan<S>::steering_;

    Pull fill(UnderrunPolicy underrun) noexcept;
    Pull take(UnderrunPolicy underrun) noexcept;
    [[nodiscard]] double wanted_sq(const Cell<S>& cell, double most_sq) const noexcept;
    void want() noexcept;
    bool answer(double from, const SpeedState& state) noexcept;
    bool change_line(double from, const SpeedState& state) noexcept;
    bool change_curve(double from, const SpeedState& state) noexcept;
    void follow_steering() noexcept;
    void plan(bool ended) noexcept;
    std::size_t rest_to_rest(std::size_t first, std::size_t end) noexcept;
    void expect_again() noexcept;
    void forward_step() noexcept;
    void forward_step_on_line() noexcept;

    GradedFeed<S> source_;
    const MotionLimits<S>* limits_;
    JerkWindow<S> window_;
    LineTravel line_{};         // while a straight leg is travelled
    MoveLimits line_limits_{};  // of it
    std::size_t committed_ = 0; // cells from the front on
    std::size_t planned_ = 0;   // cells from the front on that have a plan, at rest at its end
    std::size_t halt_ = 0;      // cells from the front on to the stop that a hold made; 0: none
    std::size_t hops_ = 1;      // cells that are hopped where no plan is found; twice as many each time
    std::uint64_t slow_legs_ = 0;
    double on_line_mm_ = 0.0; // of the cell, already travelled
    bool chosen_ = false;
    bool planned_all_ = false; // nothing came in since the last plan
    bool unanswered_ = false;  // the steering, for which no motion was found yet
};

} // namespace splinefeed
