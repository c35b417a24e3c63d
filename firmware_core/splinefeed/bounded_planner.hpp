// SPDX-License-Identifier: MIT
// BoundedPlanner: the planner for limits with jerk and JerkTier::bounded. It keeps the jerk limits by a moving average
// over an acceleration-limited motion. It computes in the scalar of the pipeline: for microcontrollers.
#pragma once

#include "splinefeed/planner.hpp"
#include "splinefeed/s4_segment_stream/smooth_sampler.hpp"

namespace splinefeed {

/// Memory of a BoundedPlanner, owned by the caller.
template <Scalar S>
struct SmoothStorage {
    std::span<SmoothCell<S>> cells;
    std::span<PathPosition> places; ///< at least SmoothSampler::places_for(limits)
};

/// Cost: constant per cell of the path and per feed segment.
template <Scalar S>
class BoundedPlanner final : public Planner<S> {
public:
    /// @param window   window of the acceleration-limited plan that bounds its speeds
    /// @param storage  at least SmoothPlan::smallest_window cells, and the places
    constexpr BoundedPlanner(std::span<PlannedCell<S>> window, const SmoothStorage<S>& storage) noexcept
        : Planner<S>(window), storage_(storage) {}

    /// @pre a trajectory was made with this planner
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
