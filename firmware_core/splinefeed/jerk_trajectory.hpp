// SPDX-License-Identifier: MIT
// JerkTrajectory: the pipeline with a jerk-limited plan: curve source -> arc length -> feed plan -> jerk plan ->
// segment stream.
#pragma once

#include "splinefeed/s3_feed_plan/jerk_plan.hpp"
#include "splinefeed/trajectory.hpp"

namespace splinefeed {

/// A Trajectory for limits that are jerk_limited. It calculates in double whatever the scalar is.
template <Scalar S>
class JerkTrajectory final : public Trajectory<S> {
public:
    JerkTrajectory(CurveSource<S>& curve, const MotionLimits<S>& limits, std::span<PlannedCell<S>> window,
                   const JerkStorage<S>& storage) noexcept
        : Trajectory<S>(curve, limits, window), jerk_plan_(Trajectory<S>::speeds(), limits, storage) {
        this->refine(jerk_plan_);
    }

    [[nodiscard]] const JerkPlan<S>& jerk_plan() const noexcept { return jerk_plan_; }

private:
    JerkPlan<S> jerk_plan_;
};

} // namespace splinefeed
