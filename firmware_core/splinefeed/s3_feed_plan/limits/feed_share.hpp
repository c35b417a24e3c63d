// SPDX-License-Identifier: MIT
// feed_share: the part of the speed along the path that counts as feed, if some axes are rotary.
#pragma once

#include "splinefeed/s2_arc_length/cell.hpp"
#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"

namespace splinefeed {

/// The largest |dq/ds| over the cell of the axes that define the feed. These are the linear axes if any of them moves,
/// otherwise the rotary axes, as in NIST's RS274/NGC and LinuxCNC. In (0, 1]; 1 if all axes are of one kind, and where
/// the move came with its feed along the path. In a cell a linear axis counts as moving if the linear axes travel more
/// than 2^-17 of its length. Cost: four norms if the axes are mixed.
template <Scalar S>
[[nodiscard]] S feed_share(const Cell<S>& cell, const MotionLimits<S>& limits) noexcept;

/// Whether the axes that define the feed of the cell are linear ones, or the machine has none.
template <Scalar S>
[[nodiscard]] bool feed_is_linear(const Cell<S>& cell, const MotionLimits<S>& limits) noexcept;

} // namespace splinefeed
