// SPDX-License-Identifier: MIT
//
// Square roots of 128-bit integers, exact to the last bit. A table of 192 bytes and two iterations give the upper half
// of the root, one division gives the lower half. Every step is integer arithmetic: the same on every target.
#pragma once

#include "splinefeed/number/wide.hpp"

#include <array>
#include <cstddef>
#include <type_traits>

namespace splinefeed {

namespace detail {

/// Entry i is for x in [(i+64)/256, (i+65)/256): 256/sqrt of the middle of that interval, rounded, minus 256.
consteval std::array<std::uint8_t, 192> make_reciprocal_root_table() {
    std::array<std::uint8_t, 192> table{};
    std::uint32_t root = 512;
    for (std::uint32_t i = 0; i < table.size(); ++i) {
        // 256/sqrt((2i+129)/512) >= root - 1/2  <=>  (2 root - 1)^2 (2i+129) <= 2^27
        while ((2 * root - 1) * (2 * root - 1) * (2 * i + 129) > (1U << 27)) {
            --root;
        }
        table[i] = static_cast<std::uint8_t>(root - 256);
    }
    return table;
}

inline constexpr std::array<std::uint8_t, 192> reciprocal_root_table = make_reciprocal_root_table();

/// floor(sqrt(n)) for a normalised n >= 2^62; the root has exactly 32 bits. Cost: seven multiplies, no division.
///
/// Let x = n / 2^64 in [1/4, 1). The table gives y0 = 1/sqrt(x) with a relative error of 2^-7.7. One Newton step gives
/// y1 with an error of 2^-14.6. One step of third order on s1 = x y1 gives the root with an error of 2^-38, much less
/// than its last bit, 2^-32.
constexpr std::uint64_t normalised_root(std::uint64_t n) noexcept {
    // Both residuals h = 1 - x y^2 are below 1/2 and are computed modulo 1. The leading bits of the product would need
    // a wider word, but they are known to cancel.
    const auto y0 = 256U + static_cast<std::uint32_t>(reciprocal_root_table[static_cast<std::size_t>((n >> 56) - 64)]);
    const auto h0 = static_cast<std::int32_t>(0U - static_cast<std::uint32_t>(n >> 48) * (y0 * y0)); // Q32
    // y1 = y0 + y0 h0 / 2 in Q16: y0 is Q8 with 9 bits, h0 >> 10 is Q22 with 17 bits.
    const std::int32_t step = (static_cast<std::int32_t>(y0) * (h0 >> 10)) >> 15;
    const auto y1 = static_cast<std::uint64_t>((static_cast<std::int32_t>(y0) << 8) + step);
    const std::uint64_t s1 = (n >> 18) * y1;                                               // Q62
    const auto h1 = static_cast<std::int64_t>((std::uint64_t{1} << 63) - (s1 >> 15) * y1); // Q63
    // 1/sqrt(1 - h) = 1 + h/2 + 3 h^2/8 + ... The first omitted term, 5 h^3/16 with |h| < 2^-13.6, is below 2^-42. It
    // makes s too large if h < 0. Subtracting one unit of 2^-40 makes s always too small, as the truncations do.
    const std::int64_t h = h1 >> 23;                       // Q40
    const std::int64_t c = (h >> 1) + ((3 * h * h) >> 43); // Q40
    const std::int64_t s = static_cast<std::int64_t>(s1 >> 22) + ((static_cast<std::int64_t>(s1 >> 30) * c) >> 32) - 1;
    // The integer part is right, or one too small just above an integer; the exact square decides.
    const std::uint64_t root = static_cast<std::uint64_t>(s) >> 8;
    return root + (n - root * root > 2 * root ? 1U : 0U);
}

#ifdef __x86_64__
/// sqrt(a) rounded to nearest, from the processor's root of a number that differs from a by 2^-51 of it or by 1, and
/// the lower word of a. @pre a < 2^102: then that root is nearer than 1
[[nodiscard]] inline std::uint64_t root_near(double about, std::uint64_t lower) noexcept {
    double estimate = 0.0;
    __asm__("sqrtsd %1, %0" : "=x"(estimate) : "x"(about));
    constexpr double half = 0.5; // the sum is exact: the estimate is not negative and below 2^51
    const auto root = static_cast<std::int64_t>(estimate + half);
    const auto rest =
        static_cast<std::int64_t>(lower - static_cast<std::uint64_t>(root) * static_cast<std::uint64_t>(root));
    return static_cast<std::uint64_t>(root + (rest > root ? 1 : 0) - (rest <= -root && root > 0 ? 1 : 0));
}
#endif

} // namespace detail

/// sqrt(a) rounded to nearest, for a < 2^63. Cost: seven multiplies.
[[nodiscard]] constexpr std::uint32_t square_root_rounded(std::uint64_t a) noexcept {
    SPLINEFEED_ASSERT((a >> 63) == 0);
#ifdef __x86_64__
    if (!std::is_constant_evaluated()) {
        return static_cast<std::uint32_t>(detail::root_near(static_cast<double>(static_cast<std::int64_t>(a)), a));
    }
#endif
    if (a == 0) {
        return 0;
    }
    // With a shift of at least two the root has one more bit, which decides; otherwise the remainder does.
    const int shift = std::countl_zero(a) & 62;
    const std::uint64_t root = detail::normalised_root(a << shift);
    if (shift == 0) {
        return static_cast<std::uint32_t>(root + (a - root * root > root ? 1U : 0U));
    }
    return static_cast<std::uint32_t>(((root >> ((shift >> 1) - 1)) + 1U) >> 1);
}

/// floor(sqrt(a)), exact for every a. Cost: ten multiplies and one 64/32 division.
[[nodiscard]] constexpr std::uint64_t square_root(Wide a) noexcept {
    if (a.high == 0 && a.low == 0) {
        return 0;
    }
    // Scaling by a power of four scales the root by a power of two, and floor(floor(r) / 2^k) = floor(r / 2^k).
    const int shift = leading_zeros(a) & 126; // even; below 128 because a is not zero
    const Wide n = shift_left(a, shift);
    // Zimmermann's step ("Karatsuba square root") takes the exact root s and remainder r of the upper half. Then the
    // lower digit q = (r 2^32 + next digit) / 2s is right or one too large. The numerator has 65 bits, so it is halved
    // first. q = 2^32 is possible only if the digit is 2^32 - 1.
    const std::uint64_t upper = detail::normalised_root(n.high);
    const std::uint64_t rest = n.high - upper * upper;
    const std::uint64_t half = (rest << 31) | (n.low >> 33);
    std::uint64_t lower = half / upper;
    lower = lower > detail::low_half ? detail::low_half : lower;
    const std::uint64_t left = ((half - lower * upper) << 1) | ((n.low >> 32) & 1U);
    std::uint64_t root = (upper << 32) | lower;
    // The remainder left 2^32 + last digit - q^2 is negative if the digit is too large.
    if (left <= detail::low_half && ((left << 32) | (n.low & detail::low_half)) < lower * lower) {
        --root;
    }
    return root >> (shift >> 1);
}

/// sqrt(a) rounded to nearest, for a < 2^127 (a larger a could round up to 2^64). There are no ties: the square of k +
/// 1/2 is not an integer.
[[nodiscard]] constexpr std::uint64_t square_root_rounded(Wide a) noexcept {
    SPLINEFEED_ASSERT((a.high >> 63) == 0);
#ifdef __x86_64__
    if (!std::is_constant_evaluated() && (a.high >> 38) == 0) [[likely]] {
        const auto upper = static_cast<double>(static_cast<std::int64_t>(a.high));
        return detail::root_near(upper * 0x1p64 + 2.0 * static_cast<double>(static_cast<std::int64_t>(a.low >> 1)),
                                 a.low);
    }
#endif
    if ((a.high >> 62) == 0) {
        const std::uint64_t twice = square_root(shift_left(a, 2)); // one more bit of the root decides
        return (twice >> 1) + (twice & 1U);                        // all 64 bits may be set: halve before adding
    }
    const std::uint64_t root = square_root(a);
    return root + (subtract(a, multiply(root, root)) > Wide{0U, root} ? 1U : 0U);
}

} // namespace splinefeed
