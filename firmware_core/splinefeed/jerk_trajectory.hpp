// SPDX-License-Identifier: MIT
// JerkTrajectory: the pipeline with a jerk-limited plan: curve source -> arc length -> feed plan -> jerk plan ->
// segment stream.
#pragma once

#include "splinefeed/s3_feed_plan/jerk_optimal/jerk_plan.hpp"
#include "splinefeed/trajectory.hpp"

namespace splinefeed {

/// A Trajectory for limits that are jerk_limited with JerkTier::optimal. It calculates in double whatever the scalar
/// is.
template <Scalar S>
class JerkTrajectory final : public Trajectory<S> {
public:
    JerkTrajectory(CurveSource<S>& curve, const MotionLimits<S>& limits, std::span<PlannedCell<S>> window,
                   const JerkStorage<S>& storage) noexcept
        : Trajectory<S>(curve, limits, window, fits(limits, storage)),
          jerk_plan_(Trajectory<S>::speeds(), limits, storage) {
        this->refine(jerk_plan_);
    }

    JerkTrajectory(CurveSource<S>& curve, const MotionLimits<S>&& limits, std::span<PlannedCell<S>> window,
                   const JerkStorage<S>& storage) = delete;

    [[nodiscard]] const JerkPlan<S>& jerk_plan() const noexcept { return jerk_plan_; }

private:
    [[nodiscard]] static Status fits(const MotionLimits<S>& limits, const JerkStorage<S>& storage) noexcept {
        if (!limits.jerk_limited || limits.jerk_tier != JerkTier::optimal) {
            return Error::planner_unsuited;
        }
        if (storage.cells.size() < JerkPlan<S>::smallest_window) {
            return Error::window_too_small;
        }
        return storage.nodes.size() < JerkStorage<S>::nodes_for(storage.cells.size()) ? Error::storage_too_small
                                                                                      : Error::none;
    }

    JerkPlan<S> jerk_plan_;
};

} // namespace splinefeed
