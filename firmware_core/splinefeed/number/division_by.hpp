// SPDX-License-Identifier: MIT
// DivisionBy: a divisor that serves several quotients, which then share what a division needs to know of it.
#pragma once

#include "splinefeed/number/scalar.hpp"

namespace splinefeed {

namespace detail {

/// A divisor of one word, as Divisor is one of two: Moeller and Granlund's algorithm 4.
class WordDivisor {
public:
    /// @pre value > 0
    constexpr explicit WordDivisor(std::uint32_t value) noexcept
        : normalised_(value << std::countl_zero(value)), shift_(std::countl_zero(value)) {
#ifndef __SIZEOF_INT128__
        reciprocal_ = word_reciprocal(normalised_);
#endif
    }

    [[nodiscard]] constexpr std::uint32_t value() const noexcept {
        return normalised_ >> shift_;
    }
    /// The divisor times 2^shift(); its top bit is set.
    [[nodiscard]] constexpr std::uint32_t normalised() const noexcept {
        return normalised_;
    }
    [[nodiscard]] constexpr int shift() const noexcept {
        return shift_;
    }

    /// (rest * 2^32 + digit) / normalised(): returns the quotient and updates the rest. @pre rest < normalised()
    constexpr std::uint32_t divide(std::uint32_t& rest, std::uint32_t digit) const noexcept {
#ifdef __SIZEOF_INT128__
        const std::uint64_t numerator = (static_cast<std::uint64_t>(rest) << 32) | digit;
        const std::uint64_t quotient = numerator / normalised_;
        rest = static_cast<std::uint32_t>(numerator - quotient * normalised_);
        return static_cast<std::uint32_t>(quotient);
#else
        const std::uint64_t estimate =
            long_product(reciprocal_, rest) + ((static_cast<std::uint64_t>(rest) << 32) | digit);
        auto quotient = static_cast<std::uint32_t>(estimate >> 32) + 1U;
        std::uint32_t left = digit - quotient * normalised_;
        if (left > static_cast<std::uint32_t>(estimate)) {
            --quotient;
            left += normalised_;
        }
        if (left >= normalised_) [[unlikely]] {
            ++quotient;
            left -= normalised_;
        }
        rest = left;
        return quotient;
#endif
    }

private:
    std::uint32_t normalised_;
#ifndef __SIZEOF_INT128__
    std::uint32_t reciprocal_;
#endif
    int shift_;
};

} // namespace detail

/// Divides by one number of N. Of a type without reciprocals it is the number.
template <Numeric N>
class DivisionBy {
public:
    constexpr DivisionBy() noexcept = default;
    /// @pre divisor > 0
    constexpr explicit DivisionBy(N divisor) noexcept : divisor_(divisor) {}

    [[nodiscard]] friend constexpr N operator/(N a, const DivisionBy& by) noexcept { return a / by.divisor_; }

private:
    N divisor_{from_integer<N>(1)};
};

/// Cost: a short divide and four multiplies for the divisor, then two multiplies for a quotient.
template <>
class DivisionBy<ShortFixed> {
public:
    /// By the largest number.
    constexpr DivisionBy() noexcept = default;
    /// @pre divisor > 0; otherwise by one ulp
    constexpr explicit DivisionBy(ShortFixed divisor) noexcept
        : by_(divisor.raw() > 0 ? static_cast<std::uint32_t>(divisor.raw()) : 1U) {}

    /// Rounded to nearest, ties away from zero; saturates.
    [[nodiscard]] friend constexpr ShortFixed operator/(ShortFixed a, const DivisionBy& by) noexcept {
        return by.quotient(a);
    }

private:
    [[nodiscard]] constexpr ShortFixed quotient(ShortFixed a) const noexcept {
        const auto sign = static_cast<std::uint32_t>(a.raw() >> 31);
        const std::uint32_t size = (static_cast<std::uint32_t>(a.raw()) ^ sign) - sign;
        if ((size >> 1) >= by_.value()) [[unlikely]] { // a quotient of 2 at least
            return sign != 0 ? ShortFixed::lowest() : ShortFixed::max();
        }
        const int shift = ShortFixed::fraction_bits + by_.shift() - 32; // -1 at least
        std::uint32_t rest = shift < 0 ? size >> 1 : size << shift;
        std::uint32_t result = by_.divide(rest, shift < 0 ? size << 31 : 0U);
        result += rest >= by_.normalised() - rest ? 1U : 0U;
        result -= result >> 31; // rounded up to 2
        return ShortFixed::from_raw(static_cast<std::int32_t>((result ^ sign) - sign));
    }

    detail::WordDivisor by_{static_cast<std::uint32_t>(std::numeric_limits<std::int32_t>::max())};
};

/// Division by Fixed, as by its operator. Cost: a short divide and ten multiplies for the divisor, then three
/// multiplies for a quotient below 1, or five.
template <>
class DivisionBy<Fixed> {
public:
    /// By 1.
    constexpr DivisionBy() noexcept = default;
    /// @pre divisor > 0; otherwise by one ulp
    constexpr explicit DivisionBy(Fixed divisor) noexcept : divisor_(divisor.raw() > 0 ? divisor.raw() : 1) {
#ifndef __SIZEOF_INT128__
        by_ = detail::Divisor(static_cast<std::uint64_t>(divisor_));
#endif
    }

    /// Rounded to nearest, ties away from zero; saturates.
    [[nodiscard]] friend constexpr Fixed operator/(Fixed a, const DivisionBy& by) noexcept {
#ifdef __SIZEOF_INT128__
        return Fixed::from_raw(detail::quotient(a.raw(), by.divisor_));
#else
        if (detail::quotient_overflows(detail::magnitude(a.raw()), static_cast<std::uint64_t>(by.divisor_)))
            [[unlikely]] {
            return a < Fixed{} ? Fixed::lowest() : Fixed::max();
        }
        return Fixed::from_raw(detail::quotient_of_digits(a.raw(), by.divisor_, by.by_).raw);
#endif
    }

private:
    std::int64_t divisor_ = std::int64_t{1} << detail::fixed_fraction_bits;
#ifndef __SIZEOF_INT128__
    detail::Divisor by_{std::uint64_t{1} << detail::fixed_fraction_bits};
#endif
};

/// a / (b / 4) for a >= 0 and b > 0, rounded up by one ulp at most; the largest number if it does not fit. The quotient
/// that belongs to quarter_product. Cost: a short divide and ten multiplies.
[[nodiscard]] constexpr Fixed quotient_by_quarter(Fixed a, ShortFixed b) noexcept {
    SPLINEFEED_ASSERT(a.raw() >= 0 && b.raw() > 0);
    const auto divisor = static_cast<std::uint32_t>(b.raw());
    if ((a.raw() >> 31) >= divisor) [[unlikely]] {
        return Fixed::max(); // a 2^32 / b is 2^63 at least
    }
#ifdef __SIZEOF_INT128__
    const auto raw = static_cast<std::uint64_t>(a.raw());
    const WideQuotient exact = divide(Wide{raw >> 32, raw << 32}, divisor);
    return Fixed::from_raw(static_cast<std::int64_t>(exact.quotient + (exact.remainder != 0 ? 1U : 0U)));
#else
    const detail::WordDivisor by(divisor);
    const auto numerator = static_cast<std::uint64_t>(a.raw()) << by.shift();
    auto rest = static_cast<std::uint32_t>(numerator >> 32);
    const std::uint32_t whole = by.divide(rest, static_cast<std::uint32_t>(numerator));
    const std::uint32_t fraction = by.divide(rest, 0);
    return Fixed::from_raw(static_cast<std::int64_t>((static_cast<std::uint64_t>(whole) << 32) | fraction) +
                           (rest != 0 ? 1 : 0));
#endif
}

/// a * b / 4
template <Floating S>
[[nodiscard]] constexpr S quarter_product(S a, S b) noexcept {
    return a * b * S(0.25);
}

/// a / (b / 4) for a >= 0 and b > 0; the largest number if it does not fit.
template <Floating S>
[[nodiscard]] constexpr S quotient_by_quarter(S a, S b) noexcept {
    return quotient_or_max(a, b * S(0.25));
}

} // namespace splinefeed
