// SPDX-License-Identifier: MIT
// AccelerationPlanner: the planner for limits without jerk. It plans the highest speeds that keep the limits of
// velocity and acceleration.
#pragma once

#include "splinefeed/planner.hpp"
#include "splinefeed/s4_segment_stream/profile_sampler.hpp"

namespace splinefeed {

/// Cost: constant per cell of the path (see FeedPlan).
template <Scalar S>
class AccelerationPlanner final : public Planner<S> {
public:
    /// @param window  the look-ahead window, at least FeedPlan::smallest_window cells
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
