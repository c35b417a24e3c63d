// SPDX-License-Identifier: MIT
// axis_velocity: how fast an axis may be in a cell: its own limit, and near the ends of its travel another.
#pragma once

#include "splinefeed/s2_arc_length/cell.hpp"
#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"

namespace splinefeed {

/// The velocity limit of the axis in all of the cell. Where some part of the cell may lie beyond Refinement::open it is
/// MotionLimits::end_velocity_mm_s; how far the axis goes is judged by its ends and the bound of |dq/ds|.
template <Scalar S>
[[nodiscard]] S axis_velocity(const Cell<S>& cell, const MotionLimits<S>& limits, unsigned axis) noexcept;

} // namespace splinefeed
