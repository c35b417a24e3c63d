// SPDX-License-Identifier: MIT
// AccelerationPlanner: the planner for limits without jerk. The fastest speeds within velocities and accelerations.
#pragma once

#include "splinefeed/planner.hpp"
#include "splinefeed/s4_segment_stream/profile_sampler.hpp"

namespace splinefeed {

/// Cost: constant per cell of the path, FeedPlan's.
template <Scalar S>
class AccelerationPlanner final : public Planner<S> {
public:
    /// @param window  FeedPlan::smallest_window cells or more: how far it looks ahead
    explicit constexpr AccelerationPlanner(std::span<PlannedCell<S>> window) noexcept : Planner<S>(window) {}

private:
    using typename Planner<S>::Stages;

    [[nodiscard]] Status fits(const MotionLimits<S>& limits) const noexcept override {
        return limits.jerk_limited ? Error::planner_unsuited : Error::none;
    }
    [[nodiscard]] Stages build(FeedPlan<S>& speeds, const MotionLimits<S>& limits) noexcept override {
        return {&speeds, &sampler_.build(speeds, limits)};
    }

    Slot<ProfileSampler<S>> sampler_;
};

} // namespace splinefeed
