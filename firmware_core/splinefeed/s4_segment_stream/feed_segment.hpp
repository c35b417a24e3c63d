// SPDX-License-Identifier: MIT
// FeedSegment: a piece of motion that a drive can execute without further questions. It is the only core type that the
// HAL knows.
#pragma once

#include "splinefeed/base/capacity.hpp"

#include <cstdint>

namespace splinefeed {

/// Position units per count. It is divisible by 6, so the joints of a cubic B-spline are whole numbers if its control
/// points are multiples of 6 units. Every whole count is such a multiple.
inline constexpr std::int64_t units_per_count = std::int64_t{3} << 30;

/// A cubic in time for each axis, in integers: positions in units, velocities in units per segment, duration in ticks
/// of 1/8 us. Axes that the machine does not have are 0. A segment starts exactly where the previous one ends, in
/// position, velocity and acceleration (start_velocity and end_velocity are three times differences of the control
/// points; see segment_stream.cpp).
struct FeedSegment {
    std::uint64_t index = 0;
    std::uint32_t duration_ticks = 0;
    std::uint32_t waypoint = 0; ///< index of the waypoint that the segment leads to or passes, modulo 2^32
    PerAxis<std::int64_t> start{};
    PerAxis<std::int64_t> end{};
    PerAxis<std::int64_t> start_velocity{};
    PerAxis<std::int64_t> end_velocity{};

    /// Whether every axis stands at its end.
    [[nodiscard]] constexpr bool ends_at_rest() const noexcept {
        bool rests = true; // a comparison of the arrays would call memcmp, which a firmware does not have
        for (const std::int64_t velocity : end_velocity) {
            rests = rests && velocity == 0;
        }
        return rests;
    }
};

} // namespace splinefeed
