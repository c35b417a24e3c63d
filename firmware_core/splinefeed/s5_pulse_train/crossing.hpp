// SPDX-License-Identifier: MIT
// Crossing: the instant at which an axis passes a position, where nothing near is known of it.
#pragma once

#include "splinefeed/s5_pulse_train/axis_cubic.hpp"

#include <cstdint>

namespace splinefeed {

/// Where to look; between the instants the position does not fall [instants: 2^-32 of the duration].
struct CrossingSearch {
    std::int64_t units = 0; ///< the position, from the segment's start
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    std::uint32_t guess = 0; ///< in between
    std::uint32_t near = 0;  ///< what the instant may be off
};

/// The instant, within `near` but for the rounding of the position (AxisCubic::at). Cost: two to four rounds with one
/// 32 bit division each; at most 44.
[[nodiscard]] std::uint32_t find_crossing(const AxisCubic& cubic, const CrossingSearch& search) noexcept;

} // namespace splinefeed
