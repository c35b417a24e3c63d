// SPDX-License-Identifier: MIT
//
// Fixed-point numbers in Q31.32, for processors without a floating-point unit. Every operation is exact or rounded to
// nearest, gives the same bits on every target, and can be evaluated by the compiler.
#pragma once

#include "splinefeed/number/raw.hpp"

#include <concepts>

namespace splinefeed {

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

    [[nodiscard, gnu::always_inline]] static constexpr Fixed from_raw(std::int64_t raw) noexcept {
        Fixed result;
        result.raw_ = raw;
        return result;
    }

    [[nodiscard, gnu::always_inline]] constexpr std::int64_t raw() const noexcept { return raw_; }

    /// 2^31 - 2^-32.
    [[nodiscard]] static constexpr Fixed max() noexcept { return from_raw(std::numeric_limits<std::int64_t>::max()); }

    /// -2^31. It has no positive counterpart: negating it overflows.
    [[nodiscard]] static constexpr Fixed lowest() noexcept {
        return from_raw(std::numeric_limits<std::int64_t>::min());
    }

    static constexpr int fraction_bits = detail::fixed_fraction_bits;
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

    // A broken precondition is asserted apart from the arithmetic, so that the saturated results can be tested in a
    // debug build as well.
    [[nodiscard, gnu::always_inline]] constexpr Fixed operator-() const noexcept {
        SPLINEFEED_ASSERT(detail::checked_difference(0, raw_).fits);
        return from_raw(detail::difference(0, raw_));
    }

    [[nodiscard, gnu::always_inline]] friend constexpr Fixed operator+(Fixed a, Fixed b) noexcept {
        SPLINEFEED_ASSERT(detail::checked_sum(a.raw_, b.raw_).fits);
        return from_raw(detail::sum(a.raw_, b.raw_));
    }

    [[nodiscard, gnu::always_inline]] friend constexpr Fixed operator-(Fixed a, Fixed b) noexcept {
        SPLINEFEED_ASSERT(detail::checked_difference(a.raw_, b.raw_).fits);
        return from_raw(detail::difference(a.raw_, b.raw_));
    }

    /// Cost: three 32x32->64 multiplies if both are below 2^15, otherwise four.
    [[nodiscard, gnu::always_inline]] friend constexpr Fixed operator*(Fixed a, Fixed b) noexcept {
        SPLINEFEED_ASSERT(detail::checked_product(a.raw_, b.raw_).fits);
        return from_raw(detail::product(a.raw_, b.raw_));
    }

    /// Precondition: b != 0. Cost: thirteen multiplies and a short divide, ten if |a| < |b|.
    [[nodiscard, gnu::always_inline]] friend constexpr Fixed operator/(Fixed a, Fixed b) noexcept {
        SPLINEFEED_ASSERT(detail::checked_quotient(a.raw_, b.raw_).fits);
        return from_raw(detail::quotient(a.raw_, b.raw_));
    }

    [[gnu::always_inline]] constexpr Fixed& operator+=(Fixed other) noexcept { return *this = *this + other; }

    [[gnu::always_inline]] constexpr Fixed& operator-=(Fixed other) noexcept { return *this = *this - other; }

    [[gnu::always_inline]] constexpr Fixed& operator*=(Fixed other) noexcept { return *this = *this * other; }

    [[gnu::always_inline]] constexpr Fixed& operator/=(Fixed other) noexcept { return *this = *this / other; }

    [[nodiscard]] friend constexpr bool operator==(Fixed a, Fixed b) noexcept { return a.raw_ == b.raw_; }
    // One by one: compilers make <=> and a comparison of its result where this is one comparison.
    [[nodiscard]] friend constexpr bool operator<(Fixed a, Fixed b) noexcept { return a.raw_ < b.raw_; }
    [[nodiscard]] friend constexpr bool operator>(Fixed a, Fixed b) noexcept { return a.raw_ > b.raw_; }
    [[nodiscard]] friend constexpr bool operator<=(Fixed a, Fixed b) noexcept { return a.raw_ <= b.raw_; }
    [[nodiscard]] friend constexpr bool operator>=(Fixed a, Fixed b) noexcept { return a.raw_ >= b.raw_; }

private:
    std::int64_t raw_ = 0;
};

} // namespace splinefeed
