// SPDX-License-Identifier: MIT
// feed_share: how much of the speed along the path the feed counts, where some axes are rotary.
#pragma once

#include "splinefeed/s2_arc_length/cell.hpp"
#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"

namespace splinefeed {

/// The largest |dq/ds| over the cell of the axes that the feed is measured on: the linear ones where any of them moves,
/// else the rotary ones, as NIST's RS274/NGC and LinuxCNC have it. In (0, 1]; 1 where all axes are of one kind.
/// A linear axis moves where the linear axes are more than 2^-17 of the path's length.
/// Cost: where the axes are mixed, four norms.
template <Scalar S>
[[nodiscard]] S feed_share(const Cell<S>& cell, const MotionLimits<S>& limits) noexcept;

} // namespace splinefeed
