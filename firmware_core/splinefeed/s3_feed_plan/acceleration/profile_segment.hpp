// SPDX-License-Identifier: MIT
// Passages of an acceleration-limited plan that was steered: v^2 is linear in s.
#pragma once

#include "splinefeed/s3_feed_plan/acceleration/acceleration_bound.hpp"
#include "splinefeed/s3_feed_plan/steering/motion_plan.hpp"

namespace splinefeed {

/// Where a machine is in a cell, and what is wanted of it.
template <Scalar S>
struct SteeringTarget {
    S from{};          ///< fraction of the cell's length
    S entry_sq{};      ///< v^2 there
    S max_steady_sq{}; ///< wanted: nothing faster
    S exit_sq{};       ///< wanted at the end of the cell; at most max_steady_sq and most_sq
    S most_sq{};       ///< the largest v^2 at the end of the cell with which the path can be travelled to its end
    S known_sq{};      ///< an exit up to most_sq that the cell is known to allow; negative: none is known
    bool rest = false; ///< wanted: rest as soon as possible
};

/// The profile segment that comes nearest to what is wanted, within the cell's polygon: it brakes to the level, or
/// accelerates to the exit's speed, as hard as the cell allows, and ends where that is reached; else it runs to the end
/// of the cell. @pre some exit up to most_sq is allowed. Cost: up to some thirty times that of
/// AccelerationBound::largest_exit where a machine stops in a small part of a long cell; two to four times as a rule.
template <Scalar S>
[[nodiscard]] ProfileSegment<S> steered_segment(const Cell<S>& cell, const MotionLimits<S>& limits,
                                                const SteeringTarget<S>& aim) noexcept;

} // namespace splinefeed
