// SPDX-License-Identifier: MIT
// UnitScale: a factor with 64 significant bits, whatever its size.
#pragma once

#include "splinefeed/number/wide.hpp"

#include <bit>
#include <cstdint>

namespace splinefeed {

/// The number mantissa * 2^-shift; the highest bit of the mantissa is set; 0 < shift < 128.
struct UnitScale {
    std::uint64_t mantissa = std::uint64_t{1} << 63;
    int shift = 63;

    /// numerator / denominator, with a relative error below 2^-62. @pre both are from 1 to 2^32 - 1
    [[nodiscard]] static constexpr UnitScale ratio(std::uint32_t numerator, std::uint32_t denominator) noexcept {
        const int zeros_n = std::countl_zero(numerator);
        const int zeros_d = std::countl_zero(denominator);
        const std::uint64_t n = static_cast<std::uint64_t>(numerator) << (zeros_n + 31);  // [2^62, 2^63)
        const std::uint64_t d = static_cast<std::uint64_t>(denominator) << 32 << zeros_d; // [2^63, 2^64)
        return UnitScale{divide(Wide{n, 0}, d).quotient, 63 + zeros_n - zeros_d}.normalised();
    }

    [[nodiscard]] constexpr UnitScale normalised() const noexcept {
        const int up = std::countl_zero(mantissa);
        return {mantissa << up, shift + up};
    }

    /// The product of both, with a relative error below 2^-62.
    [[nodiscard]] constexpr UnitScale times(UnitScale other) const noexcept {
        return UnitScale{multiply(mantissa, other.mantissa).high, shift + other.shift - 64}.normalised();
    }
};

/// The nearest integer to a * scale, modulo 2^64 if it does not fit in 64 bits.
[[nodiscard]] constexpr std::int64_t scaled_by(std::int64_t a, UnitScale scale) noexcept {
    const std::uint64_t size = a < 0 ? 0U - static_cast<std::uint64_t>(a) : static_cast<std::uint64_t>(a);
    const Wide half = shift_left(Wide{0, 1}, scale.shift - 1);
    const std::uint64_t value = shift_right(add(multiply(size, scale.mantissa), half), scale.shift).low;
    return static_cast<std::int64_t>(a < 0 ? 0U - value : value);
}

/// The nearest integer to a * fraction / 2^64.
[[nodiscard]] constexpr std::int64_t times_q64(std::int64_t a, std::uint64_t fraction) noexcept {
    const std::uint64_t size = a < 0 ? 0U - static_cast<std::uint64_t>(a) : static_cast<std::uint64_t>(a);
    const Wide product = multiply(size, fraction);
    const std::uint64_t value = product.high + (product.low >> 63);
    return static_cast<std::int64_t>(a < 0 ? 0U - value : value);
}

} // namespace splinefeed
