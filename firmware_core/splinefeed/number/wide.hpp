// SPDX-License-Identifier: MIT
//
// Unsigned 128-bit integers for the products and quotients of 64-bit numbers. 64-bit targets have instructions for
// them, which compilers reach by __int128. 32-bit targets have neither: there they need only 32x32->64 multiplies and
// 64/64 divides. Both ways are exact, so they give the same bits.
#pragma once

#include "splinefeed/base/assertion.hpp"

#include <bit>
#include <compare>
#include <cstdint>

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

inline constexpr std::uint64_t low_half = 0xffffffffU;

#ifdef __SIZEOF_INT128__
__extension__ using Native = unsigned __int128;
#endif

/// a * b, by digits of 32 bits.
[[nodiscard]] constexpr Wide multiply_digits(std::uint64_t a, std::uint64_t b) noexcept {
    const std::uint64_t a0 = a & low_half;
    const std::uint64_t a1 = a >> 32;
    const std::uint64_t b0 = b & low_half;
    const std::uint64_t b1 = b >> 32;
    // The product of two digits is at most (2^32-1)^2 = 2^64 - 2^33 + 1: two more digits can be added without a carry.
    const std::uint64_t bottom = a0 * b0;
    const std::uint64_t middle = a1 * b0 + (bottom >> 32);
    const std::uint64_t cross = a0 * b1 + (middle & low_half);
    return {a1 * b1 + (middle >> 32) + (cross >> 32), (cross << 32) | (bottom & low_half)};
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

/// One digit of Knuth's algorithm D: (remainder * 2^32 + digit) / denominator, for a normalised denominator (top bit
/// set) and remainder < denominator. Returns the 32-bit digit of the quotient and updates the remainder.
constexpr std::uint64_t divide_digit(std::uint64_t& remainder, std::uint64_t digit,
                                     std::uint64_t denominator) noexcept {
    const std::uint64_t top = denominator >> 32;
    const std::uint64_t bottom = denominator & low_half;
    std::uint64_t quotient = remainder / top;
    std::uint64_t rest = remainder - quotient * top;
    // The estimate from the leading digit is never too small. Because the denominator is normalised it is at most 2 too
    // large: at most 2^32 + 1, so the product below fits: (2^32+1) (2^32-1) < 2^64. If `rest` has more than 32 bits,
    // the estimate is right: the comparison could only be false.
    while (quotient * bottom > ((rest << 32) | digit)) {
        --quotient;
        rest += top;
        if (rest > low_half) {
            break;
        }
    }
    // The exact result is below 2^64, so the overflow of the intermediate values does not matter.
    remainder = ((remainder << 32) | digit) - quotient * denominator;
    return quotient;
}

/// numerator / denominator, by digits of 32 bits. @pre 0 < numerator.high < denominator
[[nodiscard]] constexpr WideQuotient divide_digits(Wide numerator, std::uint64_t denominator) noexcept {
    const int shift = std::countl_zero(denominator);
    const std::uint64_t normalised = denominator << shift;
    const Wide shifted = shift_left(numerator, shift);
    std::uint64_t remainder = shifted.high;
    const std::uint64_t upper = divide_digit(remainder, shifted.low >> 32, normalised);
    const std::uint64_t lower = divide_digit(remainder, shifted.low & low_half, normalised);
    return {(upper << 32) | lower, remainder >> shift};
}

} // namespace detail

/// numerator / denominator with remainder. Precondition: numerator.high < denominator, so that the quotient fits in 64
/// bits; otherwise all bits of the quotient are set and the remainder is zero. Cost: one divide; on a 32-bit target one
/// 64-bit divide if the numerator has 64 bits, otherwise two 64/32 divides and four multiplies.
[[nodiscard]] constexpr WideQuotient divide(Wide numerator, std::uint64_t denominator) noexcept {
    SPLINEFEED_ASSERT(numerator.high < denominator);
    if (numerator.high >= denominator) {
        return {~std::uint64_t{0}, 0U};
    }
    if (numerator.high == 0) {
        const std::uint64_t quotient = numerator.low / denominator;
        return {quotient, numerator.low - quotient * denominator};
    }
#ifdef __SIZEOF_INT128__
    const auto whole = (static_cast<detail::Native>(numerator.high) << 64) | numerator.low;
    const auto quotient = static_cast<std::uint64_t>(whole / denominator);
    return {quotient, numerator.low - quotient * denominator};
#else
    return detail::divide_digits(numerator, denominator);
#endif
}

} // namespace splinefeed
