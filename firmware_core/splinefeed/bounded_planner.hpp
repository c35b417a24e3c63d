// SPDX-License-Identifier: MIT
// BoundedPlanner: the planner for limits with jerk and JerkTier::bounded. A moving average of a motion of limited
// acceleration, in the scalar of the pipeline: for microcontrollers.
#pragma once

#include "splinefeed/planner.hpp"
#include "splinefeed/s4_segment_stream/smooth_sampler.hpp"

namespace splinefeed {

/// Memory of a BoundedPlanner, the caller's.
template <Scalar S>
struct SmoothStorage {
    std::span<SmoothCell<S>> cells;
    std::span<PathPosition> places; ///< SmoothSampler::places_for() the limits
};

/// Cost: constant per cell of the path and per feed segment.
template <Scalar S>
class BoundedPlanner final : public Planner<S> {
public:
    /// @param window   of the acceleration-limited plan that bounds its speeds
    /// @param storage  SmoothPlan::smallest_window cells or more, and the places
    constexpr BoundedPlanner(std::span<PlannedCell<S>> window, const SmoothStorage<S>& storage) noexcept
        : Planner<S>(window), storage_(storage) {}

    /// @pre a trajectory was made of it
    [[nodiscard]] const SmoothPlan<S>& plan() const noexcept { return *plan_; }

private:
    using typename Planner<S>::Stages;

    [[nodiscard]] Status fits(const MotionLimits<S>& limits) const noexcept override {
        if (!limits.jerk_limited || limits.jerk_tier != JerkTier::bounded) {
            return Error::planner_unsuited;
        }
        if (storage_.cells.size() < SmoothPlan<S>::smallest_window) {
            return Error::window_too_small;
        }
        return storage_.places.size() < SmoothSampler<S>::places_for(limits) ? Error::storage_too_small : Error::none;
    }
    [[nodiscard]] Stages build(FeedPlan<S>& speeds, const MotionLimits<S>& limits) noexcept override {
        SmoothPlan<S>& plan = plan_.build(speeds, limits, storage_.cells);
        return {&plan, &sampler_.build(plan, storage_.places)};
    }

    SmoothStorage<S> storage_;
    Slot<SmoothPlan<S>> plan_;
    Slot<SmoothSampler<S>> sampler_;
};

} // namespace splinefeed
