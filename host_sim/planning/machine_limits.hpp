// SPDX-License-Identifier: MIT
// machine_limits: the limits of a machine file in the form that plans use.
#pragma once

#include "host_sim/base/scalar_kind.hpp"
#include "host_sim/config/machine_description.hpp"

#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"

namespace splinefeed::host {

/// Throws InputError if the numbers of the file do not go together; it names the axis and the key that is to blame.
template <Scalar S>
[[nodiscard]] MotionLimits<S> machine_limits(const MachineDescription& machine, SampledIn sampled = SampledIn::float64);

/// What those behind a plan know of its limits.
struct PlanFigures {
    int axes = 0;
    std::uint32_t segment_ticks = 0; ///< duration of a feed segment
    int segments_per_sample = 1;
    double direction_jump = 0.0; ///< Refinement::direction_jump
    PerAxis<std::uint64_t> steps_per_mm_q32{};
};

/// Of machine_limits() in that scalar. Throws likewise.
[[nodiscard]] PlanFigures plan_figures(ScalarKind scalar, const MachineDescription& machine);

} // namespace splinefeed::host
