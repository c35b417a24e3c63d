// SPDX-License-Identifier: MIT
//
// Unsigned 128-bit integers for the products and quotients of 64-bit numbers. 64-bit targets have instructions for
// them, which compilers reach by __int128. 32-bit targets have neither: there they need only the digits of digits.hpp.
// Both ways are exact, so they give the same bits.
#pragma once

#include "splinefeed/number/digits.hpp"

#include <compare>
#include <type_traits>

namespace splinefeed {

/// The number high * 2^64 + low. The order of the members makes the default comparison numeric.
struct Wide {
    std::uint64_t high = 0;
    std::uint64_t low = 0;

    friend constexpr bool operator==(const Wide&, const Wide&) noexcept = default;
    friend constexpr auto operator<=>(const Wide&, const Wide&) noexcept = default;
};

/// Quotient and remainder of `divide`: numerator = quotient * denominator + remainder, remainder < denominator.
struct WideQuotient {
    std::uint64_t quotient = 0;
    std::uint64_t remainder = 0;
};

namespace detail {

#ifdef __SIZEOF_INT128__
__extension__ using Native = unsigned __int128;
#endif

/// a * b, by digits of 32 bits.
[[nodiscard]] constexpr Wide multiply_digits(std::uint64_t a, std::uint64_t b) noexcept {
    const auto a0 = static_cast<std::uint32_t>(a);
    const auto a1 = static_cast<std::uint32_t>(a >> 32);
    const auto b0 = static_cast<std::uint32_t>(b);
    const auto b1 = static_cast<std::uint32_t>(b >> 32);
    // The product of two digits is at most (2^32-1)^2 = 2^64 - 2^33 + 1: two more digits can be added without a carry.
    const std::uint64_t bottom = long_product(a0, b0);
    const std::uint64_t middle = long_product(a1, b0) + (bottom >> 32);
    const std::uint64_t cross = long_product(a0, b1) + (middle & low_half);
    return {long_product(a1, b1) + (middle >> 32) + (cross >> 32), (cross << 32) | (bottom & low_half)};
}

} // namespace detail

/// a * b, exact. Cost: one multiply, or four 32x32->64 multiplies on a 32-bit target.
[[nodiscard]] constexpr Wide multiply(std::uint64_t a, std::uint64_t b) noexcept {
#ifdef __SIZEOF_INT128__
    const auto product = static_cast<detail::Native>(a) * b;
    return {static_cast<std::uint64_t>(product >> 64), static_cast<std::uint64_t>(product)};
#else
    return detail::multiply_digits(a, b);
#endif
}

/// a + b modulo 2^128.
[[nodiscard]] constexpr Wide add(Wide a, Wide b) noexcept {
    const std::uint64_t low = a.low + b.low;
    return {a.high + b.high + (low < a.low ? 1U : 0U), low};
}

/// a - b modulo 2^128.
[[nodiscard]] constexpr Wide subtract(Wide a, Wide b) noexcept {
    return {a.high - b.high - (a.low < b.low ? 1U : 0U), a.low - b.low};
}

/// a * 2^count modulo 2^128, 0 <= count; zero if count >= 128.
[[nodiscard]] constexpr Wide shift_left(Wide a, int count) noexcept {
    SPLINEFEED_ASSERT(count >= 0);
    if (count <= 0) {
        return a;
    }
    if (count < 64) {
        return {(a.high << count) | (a.low >> (64 - count)), a.low << count};
    }
    return {count < 128 ? a.low << (count - 64) : 0U, 0U};
}

/// floor(a / 2^count), 0 <= count; zero if count >= 128.
[[nodiscard]] constexpr Wide shift_right(Wide a, int count) noexcept {
    SPLINEFEED_ASSERT(count >= 0);
    if (count <= 0) {
        return a;
    }
    if (count < 64) {
        return {a.high >> count, (a.low >> count) | (a.high << (64 - count))};
    }
    return {0U, count < 128 ? a.high >> (count - 64) : 0U};
}

/// Number of zero bits above the highest one bit: 0 ... 128.
[[nodiscard]] constexpr int leading_zeros(Wide a) noexcept {
    return a.high != 0 ? std::countl_zero(a.high) : 64 + std::countl_zero(a.low);
}

namespace detail {

/// numerator / denominator, by digits of 32 bits. @pre numerator.high < denominator
[[nodiscard]] constexpr WideQuotient divide_digits(Wide numerator, std::uint64_t denominator) noexcept {
    const Divisor by(denominator);
    const Wide shifted = shift_left(numerator, by.shift());
    std::uint64_t rest = shifted.high;
    const std::uint64_t upper = by.divide(rest, static_cast<std::uint32_t>(shifted.low >> 32));
    const std::uint64_t lower = by.divide(rest, static_cast<std::uint32_t>(shifted.low));
    return {(upper << 32) | lower, rest >> by.shift()};
}

} // namespace detail

/// numerator / denominator with remainder. Precondition: numerator.high < denominator, so that the quotient fits in 64
/// bits; otherwise all bits of the quotient are set and the remainder is zero. Cost: one divide; on a 32-bit target
/// 13 multiplies and a short divide.
[[nodiscard]] constexpr WideQuotient divide(Wide numerator, std::uint64_t denominator) noexcept {
    SPLINEFEED_ASSERT(numerator.high < denominator);
    if (numerator.high >= denominator) {
        return {~std::uint64_t{0}, 0U};
    }
#ifdef __SIZEOF_INT128__
#ifdef __x86_64__
    if (!std::is_constant_evaluated()) { // compilers call a function, which asks again whether the quotient fits
        WideQuotient out;
        __asm__("divq %4"
                : "=a"(out.quotient), "=d"(out.remainder)
                : "0"(numerator.low), "1"(numerator.high), "r"(denominator)
                : "cc");
        return out;
    }
#endif
    if (numerator.high == 0) {
        const std::uint64_t quotient = numerator.low / denominator;
        return {quotient, numerator.low - quotient * denominator};
    }
    const auto whole = (static_cast<detail::Native>(numerator.high) << 64) | numerator.low;
    const auto quotient = static_cast<std::uint64_t>(whole / denominator);
    return {quotient, numerator.low - quotient * denominator};
#else
    return detail::divide_digits(numerator, denominator);
#endif
}

} // namespace splinefeed
