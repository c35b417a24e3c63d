// SPDX-License-Identifier: MIT
//
// float and double at the level of bits: powers of two, conversions to and from 64-bit integers, and square roots
// without the C library. They exist because on a processor with single-precision hardware the compiler's own
// conversions between float and int64 call routines in double.
#pragma once

#include "splinefeed/number/magnitude.hpp"
#include "splinefeed/number/wide_root.hpp"

#include <concepts>
#include <type_traits>

namespace splinefeed {

/// The two IEEE 754 formats.
template <class S>
concept Floating = std::same_as<S, float> || std::same_as<S, double>;

namespace detail {

/// Layout of an IEEE 754 binary format.
template <Floating S>
struct FloatLayout {
    using Bits = std::conditional_t<std::same_as<S, float>, std::uint32_t, std::uint64_t>;
    static_assert(std::numeric_limits<S>::is_iec559 && sizeof(S) == sizeof(Bits));

    static constexpr int fraction_bits = std::numeric_limits<S>::digits - 1;
    static constexpr int bias = std::numeric_limits<S>::max_exponent - 1;
    static constexpr int exponent_mask = 2 * bias + 1;
};

/// The number significand * 2^exponent; the sign is separate.
struct Decomposed {
    std::uint64_t significand = 0;
    int exponent = 0;
    bool negative = false;
    bool finite = true;
};

template <Floating S>
[[nodiscard]] constexpr Decomposed decompose(S value) noexcept {
    using Layout = FloatLayout<S>;
    using Bits = typename Layout::Bits;
    const auto bits = std::bit_cast<Bits>(value);
    const int field = static_cast<int>(bits >> Layout::fraction_bits) & Layout::exponent_mask;
    const Bits fraction = bits & ((Bits{1} << Layout::fraction_bits) - 1U);
    // A subnormal number has the exponent of the smallest normal number and no hidden bit.
    const Bits hidden = field == 0 ? Bits{0} : Bits{1} << Layout::fraction_bits;
    return {fraction | hidden, (field == 0 ? 1 : field) - Layout::bias - Layout::fraction_bits,
            (bits >> (sizeof(Bits) * 8U - 1U)) != 0, field != Layout::exponent_mask};
}

/// 2^exponent, exact, for an exponent in the normal range of S (float: -126 ... 127).
template <Floating S>
[[nodiscard]] constexpr S power_of_two(int exponent) noexcept {
    using Layout = FloatLayout<S>;
    using Bits = typename Layout::Bits;
    SPLINEFEED_ASSERT(exponent > -Layout::bias && exponent <= Layout::bias);
    return std::bit_cast<S>(static_cast<Bits>(static_cast<Bits>(exponent + Layout::bias) << Layout::fraction_bits));
}

/// value * 2^exponent rounded to the nearest integer, ties away from zero. For exponent >= -64 an infinity or NaN does
/// not fit: their bits, read as a number, are 2^128 at least.
template <Floating S>
[[nodiscard]] constexpr Checked checked_integer(S value, int exponent) noexcept {
    SPLINEFEED_ASSERT(exponent >= -64);
#ifdef __SIZEOF_INT128__
    if (!std::is_constant_evaluated()) { // a processor of 64 bits has double
        const double scaled = static_cast<double>(value) * power_of_two<double>(exponent);
        if (scaled > -0x1p62 && scaled < 0x1p62) [[likely]] {
            const auto whole = static_cast<std::int64_t>(scaled);
            const double rest = scaled - static_cast<double>(whole);
            return {whole + (rest >= 0.5 ? 1 : 0) - (rest <= -0.5 ? 1 : 0)};
        }
    }
#endif
    const Decomposed parts = decompose(value);
    return with_sign(shift_rounded(parts.significand, parts.exponent + exponent), parts.negative);
}

/// value * 2^exponent, correctly rounded (ties to even) while the result is a normal number.
template <Floating S>
[[nodiscard]] constexpr S from_integer_scaled(std::int64_t value, int exponent) noexcept {
    if constexpr (std::same_as<S, double>) {
        return static_cast<double>(value) * power_of_two<double>(exponent);
    } else {
        // Shorten the value to 31 bits; the conversion from int32 then rounds it to 24. If bits are lost, the last bit
        // is set (a sticky bit). It lies far below the 24 bits: it can break a tie, but the value is not rounded twice.
        const std::uint64_t whole = magnitude(value);
        const int width = 64 - std::countl_zero(whole);
        const int excess = width > 31 ? width - 31 : 0;
        const std::uint64_t kept = whole >> excess;
        const std::uint32_t sticky = (kept << excess) != whole ? 1U : 0U;
        const auto shortened = static_cast<std::int32_t>(static_cast<std::uint32_t>(kept) | sticky);
        return static_cast<float>(value < 0 ? -shortened : shortened) * power_of_two<float>(exponent + excess);
    }
}

/// sqrt(value) in integer arithmetic, correctly rounded. For constants, and for processors without a square root
/// instruction.
template <Floating S>
[[nodiscard]] constexpr S square_root_by_integers(S value) noexcept {
    using Layout = FloatLayout<S>;
    using Bits = typename Layout::Bits;
    const Decomposed parts = decompose(value);
    if (parts.significand == 0 || parts.negative || !parts.finite) {
        return value > S{0} ? value : S{0}; // +infinity is its own root; NaN and negative numbers give zero
    }
    // The radicand is significand * 2^shift * 2^(exponent - shift). The shift makes the exponent even and the
    // significand 2p or 2p-1 bits long. The root then has exactly the p bits of the format and is rounded once.
    constexpr int precision = Layout::fraction_bits + 1;
    int shift = 2 * precision - (64 - std::countl_zero(parts.significand));
    shift -= (parts.exponent - shift) & 1;
    const std::uint64_t root = square_root_rounded(shift_left(Wide{0U, parts.significand}, shift));
    // The root of a finite number is a normal number. Adding the integer 2^(p-1) ... 2^p to the exponent field carries
    // into that field if rounding reaches 2^p, and the result is again the right number.
    const int field = (parts.exponent - shift) / 2 + Layout::bias + Layout::fraction_bits - 1;
    const Bits base = static_cast<Bits>(field) << Layout::fraction_bits;
    return std::bit_cast<S>(static_cast<Bits>(base + static_cast<Bits>(root)));
}

/// sqrt(value) by the processor's instruction, if it has one. __builtin_sqrt is not used: without the option
/// -fno-math-errno the compiler adds a call of the library's sqrt for negative arguments, and a freestanding program
/// has no such library.
template <Floating S>
[[nodiscard]] constexpr S hardware_square_root(S value) noexcept {
    if (!std::is_constant_evaluated()) {
#if defined(__SSE2__)
        S root;
        if constexpr (std::same_as<S, double>) {
            __asm__("sqrtsd %1, %0" : "=x"(root) : "x"(value));
        } else {
            __asm__("sqrtss %1, %0" : "=x"(root) : "x"(value));
        }
        return root;
#elif defined(__aarch64__)
        S root;
        if constexpr (std::same_as<S, double>) {
            __asm__("fsqrt %d0, %d1" : "=w"(root) : "w"(value));
        } else {
            __asm__("fsqrt %s0, %s1" : "=w"(root) : "w"(value));
        }
        return root;
#elif defined(__ARM_FP)
        // Bit 2 of __ARM_FP means single precision in hardware, bit 3 double precision.
        if constexpr (std::same_as<S, double>) {
#if (__ARM_FP & 8) != 0
            double root;
            __asm__("vsqrt.f64 %P0, %P1" : "=w"(root) : "w"(value));
            return root;
#endif
        } else {
#if (__ARM_FP & 4) != 0
            float root;
            __asm__("vsqrt.f32 %0, %1" : "=t"(root) : "t"(value));
            return root;
#endif
        }
#endif
    }
    return square_root_by_integers(value);
}

} // namespace detail

} // namespace splinefeed
