// SPDX-License-Identifier: MIT
// The profile segments of an acceleration-limited plan where the speed has its peak within a cell: the machine speeds
// up, keeps its speed, and brakes.
#pragma once

#include "splinefeed/s3_feed_plan/acceleration/acceleration_bound.hpp"
#include "splinefeed/s3_feed_plan/motion_plan.hpp"

namespace splinefeed {

/// Where the machine is in a cell, and how it shall leave it. Speeds are v^2.
template <Scalar S>
struct PeakTarget {
    S from{};     ///< fraction of the cell's length
    S entry_sq{}; ///< there; at most most_sq
    S most_sq{};  ///< between the ends not faster than this
    S exit_sq{};  ///< at the end of the cell; allowed with the entry. Above most_sq: there is no peak
};

/// Whether a cell has digits for parts, and is no cusp.
template <Scalar S>
[[nodiscard]] bool has_parts(const Cell<S>& cell) noexcept;

/// The next profile segment of the way through a cell: from the entry as hard as the axes allow anywhere in it to
/// most_sq, and to the exit. It ends where the acceleration changes, so one call follows another until the end of the
/// cell. On a line there is no faster way. A part is 2^-13 of the cell at least, in float 2^-10. Cost: two divisions
/// for each axis and three more.
template <Scalar S>
[[nodiscard]] ProfileSegment<S> peaked_segment(const Cell<S>& cell, const MotionLimits<S>& limits,
                                               const PeakTarget<S>& target) noexcept;

} // namespace splinefeed
