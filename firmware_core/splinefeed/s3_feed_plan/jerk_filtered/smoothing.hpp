// SPDX-License-Identifier: MIT
// Smoothing: the moving average over time that turns an acceleration-limited motion into a jerk-limited one.
#pragma once

#include "splinefeed/number/scalar.hpp"

#include <cstdint>

namespace splinefeed {

/// The mean over a number of ticks (segment durations). The number need not be whole: the oldest tick then counts in
/// part.
template <Scalar S>
struct Smoothing {
    static constexpr int fraction_bits = 8;

    std::uint32_t duration_q8 = 0; ///< in 1/256 of a tick
    S seconds{};
    S half_s{}; ///< largest difference between the averaged speed and the speed at an instant in the average, per
                ///< acceleration

    Smoothing() noexcept = default;
    Smoothing(std::uint32_t q8, S segments_per_s) noexcept : duration_q8(q8) {
        const S per_s = scale2(segments_per_s, fraction_bits);
        const S duration = from_integer<S>(static_cast<std::int32_t>(q8));
        seconds = duration / per_s;
        // An average over N + f ticks reaches over n = N or N + 1 ticks: n^2 / (2 (N + f))
        const S reach = from_integer<S>(ticks());
        half_s = scale2(reach * (scale2(reach, fraction_bits) / duration) / segments_per_s, -1);
    }

    /// Number of ticks that the average reaches over.
    [[nodiscard]] std::int32_t ticks() const noexcept {
        return static_cast<std::int32_t>((duration_q8 + (1U << fraction_bits) - 1U) >> fraction_bits);
    }
};

} // namespace splinefeed
