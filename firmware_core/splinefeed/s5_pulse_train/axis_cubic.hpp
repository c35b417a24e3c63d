// SPDX-License-Identifier: MIT
// AxisCubic: the motion of one axis over one feed segment, in integers.
//
//   p(u) = first u + second u^2 + third u^3,   u = time / duration, p in position units from the segment's start
//
// Horner's products are of 64 and 32 bits and drop the fraction of a unit: each is less than a unit too small. So at(u)
// is too small by less than three units, 2^-30 count, and slope(u) by less than two.
#pragma once

#include "splinefeed/s4_segment_stream/feed_segment.hpp"

#include <cstdint>

namespace splinefeed {

/// floor(a * u / 2^32). Cost: two 32x32->64 multiplies.
[[nodiscard]] constexpr std::int64_t times_q32(std::int64_t a, std::uint32_t u) noexcept {
    const auto low = static_cast<std::uint64_t>(static_cast<std::uint32_t>(a)) * u;
    const auto high = static_cast<std::int64_t>(static_cast<std::int32_t>(a >> 32)) * static_cast<std::int64_t>(u);
    return high + static_cast<std::int64_t>(low >> 32);
}

/// @pre in the segment the axis travels less than 2^48 units (87381 counts), and its velocities are below 2^50 units
/// per duration: no coefficient then reaches 2^54
struct AxisCubic {
    std::int64_t first = 0;
    std::int64_t second = 0;
    std::int64_t third = 0;

    [[nodiscard]] static constexpr AxisCubic of(const FeedSegment& segment, unsigned axis) noexcept {
        const std::int64_t way = segment.end[axis] - segment.start[axis];
        const std::int64_t v0 = segment.start_velocity[axis];
        const std::int64_t v1 = segment.end_velocity[axis];
        return {v0, 3 * way - 2 * v0 - v1, v0 + v1 - 2 * way};
    }

    /// Position at u / 2^32 [units].
    [[nodiscard]] constexpr std::int64_t at(std::uint32_t u) const noexcept {
        return times_q32(times_q32(times_q32(third, u) + second, u) + first, u);
    }
    /// Velocity at u / 2^32 [units per duration].
    [[nodiscard]] constexpr std::int64_t slope(std::uint32_t u) const noexcept {
        return times_q32(times_q32(3 * third, u) + 2 * second, u) + first;
    }
};

} // namespace splinefeed
