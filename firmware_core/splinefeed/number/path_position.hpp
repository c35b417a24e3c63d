// SPDX-License-Identifier: MIT
//
// Positions along a path that may have no end: its arc length modulo 2^24 mm. Only differences are used. They are exact
// while two positions are less than 2^23 mm apart, which is much more than any window holds.
#pragma once

#include "splinefeed/number/position.hpp"

namespace splinefeed {

/// Arc length in units of 2^-40 mm, modulo 2^64. The start value does not matter. It is 1 mm before the wrap-around, so
/// every path longer than 1 mm crosses it.
struct PathPosition {
    std::uint64_t raw = ~std::uint64_t{0} << Position::fraction_bits;

    friend constexpr bool operator==(const PathPosition&, const PathPosition&) noexcept = default;
};

/// to - from in units of 2^-40 mm. @pre they are less than 2^23 mm apart
[[nodiscard]] constexpr std::int64_t units_between(PathPosition from, PathPosition to) noexcept {
    return static_cast<std::int64_t>(to.raw - from.raw);
}

/// to - from in units of 2^unit_log2 mm, as for a Position. @pre they are less than 2^23 mm apart
template <Scalar S>
[[nodiscard]] constexpr S distance(PathPosition from, PathPosition to, int unit_log2) noexcept {
    return distance<S>(Position{}, Position{units_between(from, to)}, unit_log2);
}

/// origin + offset * 2^unit_log2 mm, rounded as for a Position. @pre the offset is less than 2^23 mm
template <Scalar S>
[[nodiscard]] constexpr PathPosition displaced(PathPosition origin, S offset, int unit_log2) noexcept {
    return {origin.raw + static_cast<std::uint64_t>(displaced(Position{}, offset, unit_log2).raw)};
}

/// Converts a length, summed in units of 2^-40 mm, to mm, for the host; 2^128 units are 3e26 mm. Error: 2 roundings.
[[nodiscard]] constexpr double length_to_mm(Wide units) noexcept {
    return static_cast<double>(units.high) * 0x1p24 + static_cast<double>(units.low) * 0x1p-40;
}

} // namespace splinefeed
