// SPDX-License-Identifier: MIT
// axis_velocity: the velocity limit of an axis in a cell; near the ends of its travel another limit applies.
#pragma once

#include "splinefeed/s2_arc_length/cell.hpp"
#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"

namespace splinefeed {

/// The velocity limit of the axis in the whole cell: MotionLimits::end_velocity_mm_s if some part of the cell may lie
/// outside Refinement::open. Where the axis goes is computed from its ends and the bound of |dq/ds|.
template <Scalar S>
[[nodiscard]] S axis_velocity(const Cell<S>& cell, const MotionLimits<S>& limits, unsigned axis) noexcept;

} // namespace splinefeed
