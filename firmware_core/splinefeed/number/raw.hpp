// SPDX-License-Identifier: MIT
//
// What the operators of Fixed compute, on its raw 64-bit integers: sums, products, quotients and shifts that saturate.
// A processor of 32 bits calls a function for all but the sums, because it passes an integer in registers and a class
// through memory.
#pragma once

#include "splinefeed/number/magnitude.hpp"

#include <type_traits>

#ifdef __SIZEOF_INT128__
#define SPLINEFEED_CALLED
#else
#define SPLINEFEED_CALLED [[gnu::noinline]]
#endif

/// Defined where an instruction tells that a sum of two words overflows, and the compiler lets us ask for it.
#if defined(__thumb2__) && defined(__GCC_ASM_FLAG_OUTPUTS__)
#define SPLINEFEED_OVERFLOW_FLAG
#endif

namespace splinefeed::detail {

/// Number of fraction bits of Fixed.
inline constexpr int fixed_fraction_bits = 32;

[[nodiscard]] constexpr std::uint32_t lower_word(std::int64_t value) noexcept {
    return static_cast<std::uint32_t>(value);
}

[[nodiscard]] constexpr std::int32_t upper_word(std::int64_t value) noexcept {
    return static_cast<std::int32_t>(value >> 32);
}

// ---- products

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

/// Whether both are in -2^47 ... 2^47 - 1: in Fixed between -32768 and 32768, as nearly all operands are.
[[nodiscard]] constexpr bool both_short(std::int64_t a, std::int64_t b) noexcept {
    return (((static_cast<std::uint32_t>(upper_word(a)) + 0x8000U) |
             (static_cast<std::uint32_t>(upper_word(b)) + 0x8000U)) >>
            16) == 0;
}

/// One half, as the lower word sees it; less by one last bit if the product is negative, so that ties are rounded away
/// from zero, which is down.
[[nodiscard]] constexpr std::uint32_t rounding_of(std::int64_t a, std::int64_t b) noexcept {
    return 0x80000000U + static_cast<std::uint32_t>((upper_word(a) ^ upper_word(b)) >> 31);
}

/// a * b / 2^32 rounded as above, modulo 2^64: with the upper words as signed digits. @pre both_short(a, b)
[[nodiscard]] constexpr std::int64_t short_product(std::int64_t a, std::int64_t b) noexcept {
    const std::uint32_t a0 = lower_word(a);
    const std::uint32_t b0 = lower_word(b);
    const auto a1 = static_cast<std::uint32_t>(upper_word(a));
    const auto b1 = static_cast<std::uint32_t>(upper_word(b));
    std::uint64_t product = (static_cast<std::uint64_t>(a0) * b0 + rounding_of(a, b)) >> 32;
    product += static_cast<std::uint64_t>(a1) * b0;
    product += static_cast<std::uint64_t>(b1) * a0;
    // A negative upper word was taken for one larger by 2^32.
    const std::uint32_t top = a1 * b1 - (b0 & static_cast<std::uint32_t>(upper_word(a) >> 31)) -
                              (a0 & static_cast<std::uint32_t>(upper_word(b) >> 31));
    return static_cast<std::int64_t>(product + (static_cast<std::uint64_t>(top) << 32));
}

/// factor * word for a factor of 16 bits.
[[nodiscard]] constexpr std::int64_t short_times_word(std::int32_t factor, std::uint32_t word) noexcept {
    return static_cast<std::int64_t>(factor * static_cast<std::int32_t>(word & 0xffffU)) +
           (static_cast<std::int64_t>(factor * static_cast<std::int32_t>(word >> 16)) << 16);
}

/// The same by digits of 16 bits.
[[nodiscard]] constexpr std::int64_t short_product_of_halves(std::int64_t a, std::int64_t b) noexcept {
    const std::uint32_t a0 = lower_word(a);
    const std::uint32_t b0 = lower_word(b);
    const std::int32_t a1 = upper_word(a);
    const std::int32_t b1 = upper_word(b);
    auto product = static_cast<std::int64_t>((product_of_halves(a0, b0) + rounding_of(a, b)) >> 32);
    if (a1 != 0) {
        product += short_times_word(a1, b0);
    }
    if (b1 != 0) {
        product += short_times_word(b1, a0);
    }
    return product + static_cast<std::int64_t>(static_cast<std::uint64_t>(static_cast<std::uint32_t>(a1 * b1)) << 32);
}

/// a * b / 2^32 rounded to nearest, ties away from zero; saturates.
SPLINEFEED_CALLED [[nodiscard]] constexpr std::int64_t product(std::int64_t a, std::int64_t b) noexcept {
#ifdef __SIZEOF_INT128__
    // One half, less by one last bit if the product is negative.
    __extension__ using Signed = __int128;
    const Signed rounded =
        (static_cast<Signed>(a) * b + ((std::int64_t{1} << (fixed_fraction_bits - 1)) + ((a ^ b) >> 63))) >>
        fixed_fraction_bits;
    const auto result = static_cast<std::int64_t>(rounded);
    return result == rounded ? result : saturated((a ^ b) < 0).raw;
#else
    if (!both_short(a, b)) [[unlikely]] {
        return checked_product(a, b).raw;
    }
#ifdef SPLINEFEED_SHORT_PRODUCTS
    return short_product_of_halves(a, b);
#else
    return short_product(a, b);
#endif
#endif
}

// ---- quotients

/// Whether a * 2^32 / b is sure not to fit, for magnitudes. With at most half the denominator a quotient has at most 63
/// bits, so rounding up cannot overflow. The test excludes only quotients that do not fit anyway, and b = 0.
[[nodiscard]] constexpr bool quotient_overflows(std::uint64_t numerator, std::uint64_t denominator) noexcept {
    return (numerator >> 31) > denominator || denominator == 0;
}

/// Whether a * 2^32 / b is sure to be below one half, for magnitudes.
[[nodiscard]] constexpr bool quotient_vanishes(std::uint64_t numerator, std::uint64_t denominator) noexcept {
    return numerator < denominator >> 33;
}

/// a * 2^32 / b rounded to nearest, ties away from zero. Division by zero counts as an overflow; its sign is that of a.
[[nodiscard]] constexpr Checked checked_wide_quotient(std::int64_t a, std::int64_t b) noexcept {
    const bool negative = (a ^ b) < 0;
    const std::uint64_t numerator = magnitude(a);
    const std::uint64_t denominator = magnitude(b);
    if (quotient_overflows(numerator, denominator)) [[unlikely]] {
        return saturated(negative);
    }
    const WideQuotient result = divide(Wide{numerator >> 32, numerator << 32}, denominator);
    const bool up = result.remainder >= denominator - result.remainder;
    return with_sign(result.quotient + (up ? 1U : 0U), negative);
}

/// The same, by digits of 32 bits: one digit if |a| < |b|, otherwise two. @pre `by` is of |b|; not quotient_overflows
[[nodiscard]] constexpr Checked quotient_of_digits(std::int64_t a, std::int64_t b, const Divisor& by) noexcept {
    const std::uint64_t numerator = magnitude(a);
    const int shift = by.shift();
    std::uint32_t whole = 0;
    std::uint64_t rest = 0;
    if (numerator < magnitude(b)) {
        rest = numerator << shift;
    } else {
        rest = shift < 32 ? numerator >> (32 - shift) : numerator << (shift - 32);
        whole = by.divide(rest, shift < 32 ? static_cast<std::uint32_t>(numerator) << shift : 0U);
    }
    const std::uint32_t fraction = by.divide(rest, 0);
    const bool up = rest >= by.normalised() - rest;
    return with_sign(((static_cast<std::uint64_t>(whole) << 32) | fraction) + (up ? 1U : 0U), (a ^ b) < 0);
}

[[nodiscard]] constexpr Checked checked_quotient(std::int64_t a, std::int64_t b) noexcept {
#ifdef __SIZEOF_INT128__
    return checked_wide_quotient(a, b);
#else
    if (quotient_overflows(magnitude(a), magnitude(b))) [[unlikely]] {
        return saturated((a ^ b) < 0);
    }
    if (quotient_vanishes(magnitude(a), magnitude(b))) {
        return {};
    }
    return quotient_of_digits(a, b, Divisor(magnitude(b)));
#endif
}

/// The same, saturated.
SPLINEFEED_CALLED [[nodiscard]] constexpr std::int64_t quotient(std::int64_t a, std::int64_t b) noexcept {
    return checked_quotient(a, b).raw;
}

// ---- sums

/// The limit on the side of a value. A call, so that what leads to it takes little code.
#ifndef __SIZEOF_INT128__
[[gnu::cold, gnu::noinline]]
#endif
[[nodiscard]] constexpr std::int64_t
nearest_limit(std::int64_t value) noexcept {
    return saturated(value < 0).raw;
}

[[nodiscard, gnu::always_inline]] constexpr std::int64_t sum(std::int64_t a, std::int64_t b) noexcept {
    std::int64_t result = 0;
#ifdef SPLINEFEED_OVERFLOW_FLAG
    if (!std::is_constant_evaluated()) {
        bool overflow = false;
        __asm__("adds %Q0, %Q0, %Q3\n\tadcs %R0, %R0, %R3" : "=r"(result), "=@ccvs"(overflow) : "%0"(a), "r"(b));
        return overflow ? nearest_limit(a) : result;
    }
#endif
    return __builtin_add_overflow(a, b, &result) ? nearest_limit(a) : result;
}

[[nodiscard, gnu::always_inline]] constexpr std::int64_t difference(std::int64_t a, std::int64_t b) noexcept {
    std::int64_t result = 0;
#ifdef SPLINEFEED_OVERFLOW_FLAG
    if (!std::is_constant_evaluated()) {
        bool overflow = false;
        __asm__("subs %Q0, %Q0, %Q3\n\tsbcs %R0, %R0, %R3" : "=r"(result), "=@ccvs"(overflow) : "0"(a), "r"(b));
        return overflow ? nearest_limit(a) : result;
    }
#endif
    return __builtin_sub_overflow(a, b, &result) ? nearest_limit(a) : result;
}

// ---- shifts

/// value / 2^count rounded to nearest, ties away from zero, 1 <= count <= 31.
[[nodiscard]] constexpr std::int64_t halved(std::int64_t value, int count) noexcept {
    const std::uint32_t lost = lower_word(value) & ((1U << count) - 1U);
    const std::uint32_t half = 1U << (count - 1);
    // Less by one last bit for negative values: a tie is rounded down.
    const std::uint32_t up = (lost + half + static_cast<std::uint32_t>(upper_word(value) >> 31)) >> count;
    return (value >> count) + static_cast<std::int64_t>(up);
}

/// value * 2^count, 0 <= count <= 31; saturates.
[[nodiscard]] constexpr std::int64_t shifted_up(std::int64_t value, int count) noexcept {
    const auto upper = static_cast<std::uint32_t>(upper_word(value));
    return ((upper + (1U << (31 - count))) >> (31 - count)) > 1U
               ? nearest_limit(value)
               : static_cast<std::int64_t>(static_cast<std::uint64_t>(value) << count);
}

/// value * 2^exponent rounded to nearest, ties away from zero; saturates. Any exponent is allowed.
SPLINEFEED_CALLED [[nodiscard]] constexpr std::int64_t any_shift(std::int64_t value, int exponent) noexcept {
    if (exponent < 0) {
        return exponent >= -31 ? halved(value, -exponent) : checked_shift(value, exponent).raw;
    }
    return exponent <= 31 ? shifted_up(value, exponent) : checked_shift(value, exponent).raw;
}

/// The same; for a constant without a call.
[[nodiscard, gnu::always_inline]] constexpr std::int64_t shifted(std::int64_t value, int exponent) noexcept {
    if (__builtin_constant_p(exponent) != 0) {
        if (exponent < 0 && exponent >= -31) {
            return halved(value, -exponent);
        }
        if (exponent >= 0 && exponent < 31) {
            return shifted_up(value, exponent);
        }
    }
    return any_shift(value, exponent);
}

} // namespace splinefeed::detail
