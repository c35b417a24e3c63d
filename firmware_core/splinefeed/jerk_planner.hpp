// SPDX-License-Identifier: MIT
// JerkPlanner: the planner for limits with jerk. Its motion takes close to the least time.
#pragma once

#include "splinefeed/planner.hpp"
#include "splinefeed/s3_feed_plan/jerk/jerk_plan.hpp"
#include "splinefeed/s4_segment_stream/profile_sampler.hpp"

namespace splinefeed {

/// @tparam R  it plans in this type, whatever the scalar of the pipeline: float where the processor computes in single
/// precision, double elsewhere
template <Scalar S, Floating R = double>
class JerkPlanner final : public Planner<S> {
public:
    /// @param window   window of the acceleration-limited plan that it refines
    /// @param storage  at least JerkPlan::smallest_window cells
    constexpr JerkPlanner(std::span<PlannedCell<S>> window, const JerkStorage<S, R>& storage) noexcept
        : Planner<S>(window), storage_(storage) {}

    /// @pre a trajectory was made with this planner
    [[nodiscard]] const JerkPlan<S, R>& plan() const noexcept { return *plan_; }

private:
    using typename Planner<S>::Stages;
    using X = JerkSampled<S, R>;

    [[nodiscard]] Status fits(const MotionLimits<S>& limits) const noexcept override {
        if (!limits.jerk_limited || (limits.sampled == SampledIn::float64 && !std::same_as<X, double>)) {
            return Error::planner_unsuited;
        }
        if (storage_.cells.size() < JerkPlan<S, R>::smallest_window) {
            return Error::window_too_small;
        }
        return storage_.enough() ? Error::none : Error::storage_too_small;
    }
    [[nodiscard]] Stages build(FeedPlan<S>& speeds, const MotionLimits<S>& limits) noexcept override {
        JerkPlan<S, R>& plan = plan_.build(speeds, limits, storage_);
        return {&plan, &sampler_.build(plan, limits)};
    }

    JerkStorage<S, R> storage_;
    Slot<JerkPlan<S, R>> plan_;
    Slot<ProfileSampler<S, X>> sampler_;
};

} // namespace splinefeed
