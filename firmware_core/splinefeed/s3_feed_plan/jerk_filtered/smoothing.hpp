// SPDX-License-Identifier: MIT
// Smoothing: the moving average over time that turns an acceleration-limited motion into a jerk-limited one.
#pragma once

#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"

#include <cstdint>

namespace splinefeed {

/// a b for a, b >= 0, in Fixed at most 2^29: sums of three such products fit.
template <Scalar S>
[[nodiscard]] S bounded_product(S a, S b) noexcept {
    if constexpr (std::same_as<S, Fixed>) {
        return smaller(Fixed::from_raw(detail::product(a.raw(), b.raw())), Fixed(1 << 29));
    } else {
        return a * b;
    }
}

/// The mean over a number of ticks (segment durations). The number need not be whole: the oldest tick then counts in
/// part.
template <Scalar S>
struct Smoothing {
    static constexpr int fraction_bits = 8;
    static constexpr int close_log2 = 12;

    std::uint32_t duration_q8 = 0; ///< in 1/256 of a tick
    S seconds{};
    S half_s{}; ///< largest difference between the averaged speed and the speed at an instant in the average, per
                ///< acceleration
    PerAxis<S> change_mm_s2{}; ///< J T: largest change of an axis's acceleration within the time; in Fixed at most 2^29
    S close_mm_s2{};           ///< an acceleration so near to its limit, or J T, counts as equal to it

    Smoothing() noexcept = default;
    Smoothing(std::uint32_t q8, const MotionLimits<S>& limits) noexcept : duration_q8(q8) {
        const S segments_per_s = limits.segments_per_s;
        const S per_s = scale2(segments_per_s, fraction_bits);
        const S duration = from_integer<S>(static_cast<std::int32_t>(q8));
        seconds = duration / per_s;
        // An average over N + f ticks reaches over n = N or N + 1 ticks: n^2 / (2 (N + f))
        const S reach = from_integer<S>(ticks());
        half_s = scale2(reach * (scale2(reach, fraction_bits) / duration) / segments_per_s, -1);
        close_mm_s2 = largest<S>();
        for (const unsigned k : indices(limits.axes)) {
            change_mm_s2[k] = bounded_product(limits.jerk_mm_s3[k], seconds);
            const S least = smaller(limits.acceleration_mm_s2[k], limits.braking_mm_s2[k]);
            close_mm_s2 = smaller(close_mm_s2, scale2(smaller(change_mm_s2[k], least), -close_log2));
        }
    }

    /// Number of ticks that the average reaches over.
    [[nodiscard]] std::int32_t ticks() const noexcept {
        return static_cast<std::int32_t>((duration_q8 + (1U << fraction_bits) - 1U) >> fraction_bits);
    }
};

} // namespace splinefeed
