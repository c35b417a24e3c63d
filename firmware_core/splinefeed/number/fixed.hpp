// SPDX-License-Identifier: MIT
//
// Fixed-point numbers in Q31.32, for processors without a floating-point unit. Every operation is exact or rounded to
// nearest, gives the same bits on every target, and can be evaluated by the compiler.
#pragma once

#include "splinefeed/number/magnitude.hpp"

#include <concepts>

namespace splinefeed {

namespace detail {

/// Number of fraction bits of Fixed.
inline constexpr int fixed_fraction_bits = 32;

/// a * b / 2^32 rounded to nearest, ties away from zero.
[[nodiscard]] constexpr Checked checked_product(std::int64_t a, std::int64_t b) noexcept {
    const bool negative = (a ^ b) < 0;
    // At most 2^126: adding one half cannot overflow.
    const Wide product = add(multiply(magnitude(a), magnitude(b)), Wide{0U, std::uint64_t{1} << 31});
    if ((product.high >> 32) != 0) [[unlikely]] {
        return saturated(negative);
    }
    return with_sign((product.high << 32) | (product.low >> 32), negative);
}

/// a * 2^32 / b rounded to nearest, ties away from zero. Division by zero counts as an overflow; its sign is that of a.
[[nodiscard]] constexpr Checked checked_quotient(std::int64_t a, std::int64_t b) noexcept {
    const bool negative = (a ^ b) < 0;
    const std::uint64_t numerator = magnitude(a);
    const std::uint64_t denominator = magnitude(b);
    // With at most half the denominator the quotient has at most 63 bits, so rounding up cannot overflow. The test
    // excludes only quotients that do not fit anyway, and b = 0.
    if ((numerator >> 31) > denominator || denominator == 0) [[unlikely]] {
        return saturated(negative);
    }
    const WideQuotient result = divide(Wide{numerator >> 32, numerator << 32}, denominator);
    const bool up = result.remainder >= denominator - result.remainder;
    return with_sign(result.quotient + (up ? 1U : 0U), negative);
}

} // namespace detail

/// The number raw * 2^-32, from -2^31 to 2^31 - 2^-32. One ulp is 2^-32, about 2.3e-10, everywhere.
///
/// Sums are exact. Products and quotients are rounded to nearest, ties away from zero: error <= 1/2 ulp. An overflow is
/// a broken precondition (SPLINEFEED_ASSERT). In a release build the result is then the largest or lowest number,
/// depending on the sign; it never wraps around.
class Fixed {
public:
    /// Zero.
    constexpr Fixed() noexcept = default;

    /// An integer. Exact.
    constexpr explicit Fixed(std::int32_t value) noexcept : raw_{value * (std::int64_t{1} << 32)} {}

    /// Deleted, because Fixed(1.5) would silently be 1. Use from_double.
    explicit Fixed(std::floating_point auto) = delete;

    [[nodiscard]] static constexpr Fixed from_raw(std::int64_t raw) noexcept {
        Fixed result;
        result.raw_ = raw;
        return result;
    }

    [[nodiscard]] constexpr std::int64_t raw() const noexcept { return raw_; }

    /// 2^31 - 2^-32.
    [[nodiscard]] static constexpr Fixed max() noexcept { return from_raw(std::numeric_limits<std::int64_t>::max()); }

    /// -2^31. It has no positive counterpart: negating it overflows.
    [[nodiscard]] static constexpr Fixed lowest() noexcept {
        return from_raw(std::numeric_limits<std::int64_t>::min());
    }

    /// 2^-32, the difference of neighbouring numbers.
    [[nodiscard]] static constexpr Fixed resolution() noexcept { return from_raw(1); }

    /// Whether the value is in the range of Fixed. NaN is not.
    [[nodiscard]] static constexpr bool representable(double value) noexcept {
        // The largest double below 2^31 is 2^31 - 2^-22. Fixed holds it exactly: it cannot round up to 2^31.
        return value >= -2147483648.0 && value < 2147483648.0;
    }

    /// The nearest Fixed, ties away from zero. Precondition: representable(value); otherwise the nearer end of the
    /// range, and 0 for NaN.
    [[nodiscard]] static constexpr Fixed from_double(double value) noexcept {
        SPLINEFEED_ASSERT(representable(value));
        if (!representable(value)) {
            return value > 0.0 ? max() : value < 0.0 ? lowest() : Fixed{};
        }
        const double scaled = value * 4294967296.0;
        const auto whole = static_cast<std::int64_t>(scaled);
        const double rest = scaled - static_cast<double>(whole); // exact: a rest exists only below 2^52
        return from_raw(whole + (rest >= 0.5 ? 1 : 0) - (rest <= -0.5 ? 1 : 0));
    }

    /// The nearest double: exact if |value| < 2^21, otherwise with a relative error of up to 2^-53.
    [[nodiscard]] constexpr double to_double() const noexcept {
        return static_cast<double>(raw_) * (1.0 / 4294967296.0);
    }

    [[nodiscard]] constexpr Fixed operator+() const noexcept { return *this; }

    [[nodiscard]] constexpr Fixed operator-() const noexcept { return asserted(detail::checked_difference(0, raw_)); }

    [[nodiscard]] friend constexpr Fixed operator+(Fixed a, Fixed b) noexcept {
        return asserted(detail::checked_sum(a.raw_, b.raw_));
    }

    [[nodiscard]] friend constexpr Fixed operator-(Fixed a, Fixed b) noexcept {
        return asserted(detail::checked_difference(a.raw_, b.raw_));
    }

    /// Cost: four 32x32->64 multiplies.
    [[nodiscard]] friend constexpr Fixed operator*(Fixed a, Fixed b) noexcept {
        return asserted(detail::checked_product(a.raw_, b.raw_));
    }

    /// Precondition: b != 0. Cost: two 64/32 divides, or one if |a| < 1.
    [[nodiscard]] friend constexpr Fixed operator/(Fixed a, Fixed b) noexcept {
        return asserted(detail::checked_quotient(a.raw_, b.raw_));
    }

    constexpr Fixed& operator+=(Fixed other) noexcept { return *this = *this + other; }

    constexpr Fixed& operator-=(Fixed other) noexcept { return *this = *this - other; }

    constexpr Fixed& operator*=(Fixed other) noexcept { return *this = *this * other; }

    constexpr Fixed& operator/=(Fixed other) noexcept { return *this = *this / other; }

    friend constexpr bool operator==(const Fixed&, const Fixed&) noexcept = default;
    friend constexpr auto operator<=>(const Fixed&, const Fixed&) noexcept = default;

private:
    /// A separate step after the arithmetic, so that the saturated results can be tested in a debug build as well.
    [[nodiscard]] static constexpr Fixed asserted(detail::Checked result) noexcept {
        SPLINEFEED_ASSERT(result.fits);
        return from_raw(result.raw);
    }

    std::int64_t raw_ = 0;
};

} // namespace splinefeed
