// SPDX-License-Identifier: MIT
// SmoothTrajectory: the pipeline with a jerk-limited plan of bounded cost: curve source -> arc length -> feed plan ->
// smooth plan -> moving average -> segment stream.
#pragma once

#include "splinefeed/s4_segment_stream/smooth_sampler.hpp"
#include "splinefeed/trajectory.hpp"

namespace splinefeed {

/// Memory of a SmoothTrajectory, the caller's.
template <Scalar S>
struct SmoothStorage {
    std::span<SmoothCell<S>> cells;
    std::span<PathPosition> places; ///< SmoothSampler::places_for() the limits
};

/// A Trajectory for limits that are jerk_limited with JerkTier::bounded, in the scalar of the pipeline.
template <Scalar S>
class SmoothTrajectory final : public Trajectory<S> {
public:
    SmoothTrajectory(CurveSource<S>& curve, const MotionLimits<S>& limits, std::span<PlannedCell<S>> window,
                     const SmoothStorage<S>& storage) noexcept
        : Trajectory<S>(curve, limits, window, fits(limits, storage)),
          smooth_plan_(Trajectory<S>::speeds(), limits, storage.cells), sampler_(smooth_plan_, storage.places) {
        this->refine(smooth_plan_, sampler_);
    }

    SmoothTrajectory(CurveSource<S>& curve, const MotionLimits<S>&& limits, std::span<PlannedCell<S>> window,
                     const SmoothStorage<S>& storage) = delete;

    [[nodiscard]] const SmoothPlan<S>& smooth_plan() const noexcept { return smooth_plan_; }

private:
    [[nodiscard]] static Status fits(const MotionLimits<S>& limits, const SmoothStorage<S>& storage) noexcept {
        if (!limits.jerk_limited || limits.jerk_tier != JerkTier::bounded) {
            return Error::planner_unsuited;
        }
        if (storage.cells.size() < SmoothPlan<S>::smallest_window) {
            return Error::window_too_small;
        }
        return storage.places.size() < SmoothSampler<S>::places_for(limits) ? Error::storage_too_small : Error::none;
    }

    SmoothPlan<S> smooth_plan_;
    SmoothSampler<S> sampler_;
};

} // namespace splinefeed
