// SPDX-License-Identifier: MIT
// Units of time, in each other.
#pragma once

#include <cstdint>

namespace splinefeed {

inline constexpr int ticks_per_us = 8; ///< of a FeedSegment's duration
inline constexpr std::uint32_t ticks_per_s = 8'000'000;
inline constexpr std::uint64_t ns_per_us = 1000;
inline constexpr std::uint64_t ns_per_ms = 1'000'000;
inline constexpr std::uint64_t ns_per_s = 1'000'000'000;
inline constexpr std::uint64_t us_per_ms = 1000;
inline constexpr std::uint64_t us_per_s = 1'000'000;

[[nodiscard]] constexpr double us_to_s(double time_us) noexcept {
    return time_us / 1e6;
}

} // namespace splinefeed
