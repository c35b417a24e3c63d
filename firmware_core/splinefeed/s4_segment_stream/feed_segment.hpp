// SPDX-License-Identifier: MIT
// FeedSegment: what a drive can execute without asking back. The only core type that the HAL knows.
#pragma once

#include "splinefeed/base/capacity.hpp"

#include <cstdint>

namespace splinefeed {

/// Position units per count. Divisible by 6 (and 2^30 by nothing else of it), so that the joints of a cubic B-spline
/// whose control points are multiples of 6 units are whole numbers, and every whole count is such a multiple.
inline constexpr std::int64_t units_per_count = std::int64_t{3} << 30;

/// A cubic in time per axis, in integers: positions in units, velocities in units per segment, duration in ticks of
/// 1/8 us. The start of one is exactly the end of the one before, in position and velocity (and acceleration:
/// start_velocity and end_velocity are three times differences of the control points; see segment_stream.cpp).
struct FeedSegment {
    std::uint64_t index = 0;
    std::uint32_t duration_ticks = 0;
    std::uint32_t waypoint = 0; ///< index of the waypoint that the segment leads to or passes, modulo 2^32
    PerAxis<std::int64_t> start{};
    PerAxis<std::int64_t> end{};
    PerAxis<std::int64_t> start_velocity{};
    PerAxis<std::int64_t> end_velocity{};
};

} // namespace splinefeed
