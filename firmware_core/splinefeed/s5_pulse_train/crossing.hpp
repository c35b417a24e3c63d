// SPDX-License-Identifier: MIT
// Crossing: finds the instant at which an axis passes a position, if no instant nearby is known.
#pragma once

#include "splinefeed/s5_pulse_train/axis_cubic.hpp"

#include <cstdint>

namespace splinefeed {

/// Where to search. Between the two instants the position must not fall [instants: 2^-32 of the duration].
struct CrossingSearch {
    std::int64_t units = 0; ///< the position, from the segment's start
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    std::uint32_t guess = 0; ///< start value, between low and high
    std::uint32_t near = 0;  ///< allowed error of the instant
};

/// The instant, within `near`, plus the rounding of the position (AxisCubic::at). Cost: two to four rounds with one
/// 32-bit division each; at most 44.
[[nodiscard]] std::uint32_t find_crossing(const AxisCubic& cubic, const CrossingSearch& search) noexcept;

} // namespace splinefeed
