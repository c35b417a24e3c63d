// SPDX-License-Identifier: MIT
//
// Signed 64-bit arithmetic on sign and magnitude, with saturation. Rounding acts on the magnitude, so it is symmetric:
// a mirrored motion gives mirrored numbers, and rounding causes no drift.
#pragma once

#include "splinefeed/number/wide.hpp"

#include <limits>

namespace splinefeed::detail {

/// A result, and whether it fits. If it does not, `raw` is the nearest limit of std::int64_t.
struct Checked {
    std::int64_t raw = 0;
    bool fits = true;
};

/// value|. It is unsigned because the magnitude of the lowest value, 2^63, does not fit in the signed type.
[[nodiscard]] constexpr std::uint64_t magnitude(std::int64_t value) noexcept {
    // Negates by complement and carry, here and in with_sign: the sign of a product is unpredictable, and compilers
    // would often turn a condition into a branch.
    const auto mask = static_cast<std::uint64_t>(value >> 63);
    return (static_cast<std::uint64_t>(value) ^ mask) - mask;
}

/// The limit with this sign, marked as not fitting.
[[nodiscard]] constexpr Checked saturated(bool negative) noexcept {
    return {negative ? std::numeric_limits<std::int64_t>::min() : std::numeric_limits<std::int64_t>::max(), false};
}

/// +magnitude or -magnitude.
[[nodiscard]] constexpr Checked with_sign(std::uint64_t magnitude, bool negative) noexcept {
    const std::uint64_t mask = 0U - static_cast<std::uint64_t>(negative);
    const std::uint64_t limit = (std::uint64_t{1} << 63) - 1U - mask; // larger by one for negative numbers
    if (magnitude > limit) [[unlikely]] {
        return saturated(negative);
    }
    return {static_cast<std::int64_t>((magnitude ^ mask) - mask), true};
}

[[nodiscard]] constexpr Checked checked_sum(std::int64_t a, std::int64_t b) noexcept {
    std::int64_t sum = 0;
    return __builtin_add_overflow(a, b, &sum) ? saturated(a < 0) : Checked{sum, true};
}

[[nodiscard]] constexpr Checked checked_difference(std::int64_t a, std::int64_t b) noexcept {
    std::int64_t difference = 0;
    return __builtin_sub_overflow(a, b, &difference) ? saturated(a < 0) : Checked{difference, true};
}

/// magnitude * 2^exponent rounded to nearest, ties up; all bits are set if it does not fit. Any exponent is allowed.
[[nodiscard]] constexpr std::uint64_t shift_rounded(std::uint64_t magnitude, int exponent) noexcept {
    if (exponent >= 0) {
        if (magnitude == 0 || exponent <= std::countl_zero(magnitude)) {
            return exponent < 64 ? magnitude << exponent : 0U;
        }
        return ~std::uint64_t{0};
    }
    if (exponent < -64) {
        return 0; // below 2^64 / 2^65 = 1/2
    }
    // Shifting by one bit less first leaves room for the carry when one half is added.
    return ((magnitude >> (-exponent - 1)) >> 1) + ((magnitude >> (-exponent - 1)) & 1U);
}

/// value * 2^exponent rounded to nearest, ties away from zero. Any exponent is allowed.
[[nodiscard]] constexpr Checked checked_shift(std::int64_t value, int exponent) noexcept {
    return with_sign(shift_rounded(magnitude(value), exponent), value < 0);
}

} // namespace splinefeed::detail
