// SPDX-License-Identifier: MIT
// The profile segments of an acceleration-limited plan after a change of the steering: v^2 is linear in s.
#pragma once

#include "splinefeed/s3_feed_plan/acceleration/acceleration_bound.hpp"
#include "splinefeed/s3_feed_plan/motion_plan.hpp"

namespace splinefeed {

/// Where the machine is in a cell, and which motion is wanted.
template <Scalar S>
struct SteeringTarget {
    S from{};          ///< fraction of the cell's length
    S entry_sq{};      ///< v^2 there
    S max_steady_sq{}; ///< wanted: never faster than this
    S level_sq{};      ///< allowed anywhere in the cell; elsewhere the line from where the machine is to its exit
    S exit_sq{};       ///< wanted at the end of the cell; at most max_steady_sq and most_sq
    S most_sq{};       ///< the largest v^2 at the end of the cell from which the rest of the path can be travelled
    S known_sq{};      ///< an exit up to most_sq that the cell is known to allow; negative: none is known
    bool rest = false; ///< wanted: standstill as soon as possible
};

/// The profile segment nearest to what is wanted, within the cell's polygon. It brakes to the wanted speed, or
/// accelerates to the speed of the exit, as hard as the cell allows, and ends where that speed is reached. Otherwise
/// it runs to the end of the cell. @pre some exit up to most_sq is allowed. Cost: usually two to four times that of
/// AccelerationBound::largest_exit; up to some thirty times where a machine stops in a small part of a long cell.
template <Scalar S>
[[nodiscard]] ProfileSegment<S> steered_segment(const Cell<S>& cell, const MotionLimits<S>& limits,
                                                const SteeringTarget<S>& aim) noexcept;

} // namespace splinefeed
