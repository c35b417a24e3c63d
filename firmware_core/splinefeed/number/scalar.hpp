// SPDX-License-Identifier: MIT
//
// The number types that a controller can be built with - double, float or Fixed - behind one set of functions. An
// algorithm that is a template over Scalar uses these functions, + - * / and comparisons, and nothing else.
#pragma once

#include "splinefeed/number/fixed.hpp"
#include "splinefeed/number/floating.hpp"
#include "splinefeed/number/short_fixed.hpp"

namespace splinefeed {

template <class S>
concept Scalar = Floating<S> || std::same_as<S, Fixed>;

/// What an algorithm over S uses for numbers from -2 to 2, as ratios and directions are: S itself, but one word of
/// Fixed.
template <Scalar S>
using Ratio = std::conditional_t<std::same_as<S, Fixed>, ShortFixed, S>;

/// A Scalar, or a shorter number that serves one.
template <class N>
concept Numeric = Scalar<N> || std::same_as<N, ShortFixed>;

/// The largest number of S. For float and double it is rounded by far less than matters to anything compared with it.
template <Scalar S>
[[nodiscard]] constexpr S largest() noexcept {
    if constexpr (std::same_as<S, Fixed>) {
        return Fixed::max();
    } else {
        return std::numeric_limits<S>::max();
    }
}

// ---- square roots

/// sqrt(x) for x >= 0, correctly rounded: error <= 1/2 ulp. Cost: one instruction, or about ten multiplies and a divide
/// if the processor has no such instruction.
template <Floating S>
[[nodiscard]] constexpr S square_root(S x) noexcept {
    SPLINEFEED_ASSERT(x >= S{0});
    return detail::hardware_square_root(x);
}

/// sqrt(x) for x >= 0, correctly rounded: error <= 1/2 ulp; zero for x < 0. Cost: ten multiplies, one 64/32 divide.
[[nodiscard]] constexpr Fixed square_root(Fixed x) noexcept {
    SPLINEFEED_ASSERT(x.raw() >= 0);
    if (x.raw() <= 0) {
        return Fixed{};
    }
    // sqrt(raw / 2^32) = sqrt(raw * 2^32) / 2^32, and the root of 95 bits has 48.
    const auto raw = static_cast<std::uint64_t>(x.raw());
    return Fixed::from_raw(static_cast<std::int64_t>(square_root_rounded(Wide{raw >> 32, raw << 32})));
}

/// 1/sqrt(x) for x > 0: error < 3/2 ulp. The root may be off by 1/2 ulp. If the root is just above 1, that is a whole
/// ulp of the reciprocal just below 1; the division adds another half.
template <Floating S>
[[nodiscard]] constexpr S reciprocal_square_root(S x) noexcept {
    SPLINEFEED_ASSERT(x > S{0});
    return S{1} / square_root(x);
}

/// 1/sqrt(x) for x > 0, correctly rounded: error <= 1/2 ulp. The result is at most 2^16, so it never saturates; x <= 0
/// gives the largest number. Cost: a square root and up to four divides.
[[nodiscard]] constexpr Fixed reciprocal_square_root(Fixed x) noexcept {
    SPLINEFEED_ASSERT(x.raw() > 0);
    if (x.raw() <= 0) {
        return Fixed::max();
    }
    // The result is r = 2^48/sqrt(raw). floor(2r) = floor(sqrt(2^98/raw)) = floor(sqrt(floor(2^98/raw))). Adding one
    // before halving rounds it.
    const auto raw = static_cast<std::uint64_t>(x.raw());
    const std::uint64_t upper = (std::uint64_t{1} << 34) / raw;
    const std::uint64_t rest = (std::uint64_t{1} << 34) - upper * raw;
    const std::uint64_t twice = square_root(Wide{upper, divide(Wide{rest, 0U}, raw).quotient});
    return Fixed::from_raw(static_cast<std::int64_t>((twice + 1U) >> 1));
}

/// Length of the vector v[0] ... v[n-1], 0 <= n <= 9. The error is at most (n+1)/2 ulp if every component is zero or
/// between 2^-50 and 2^50 in magnitude; n/2 ulp of it come from the sum of squares.
template <Floating S>
[[nodiscard]] constexpr S norm(const S* v, int n) noexcept {
    SPLINEFEED_ASSERT(n >= 0 && n <= 9);
    S sum{0};
    for (int i = 0; i < n; ++i) {
        sum += v[i] * v[i];
    }
    return square_root(sum);
}

/// Length of the vector v[0] ... v[n-1], 0 <= n <= 9, |v[i]| < 2^30, with nine 2^29. The sum of squares is exact and
/// the root is rounded once: error <= 1/2 ulp. A length of 2^31 or more, possible from n = 5, gives the largest number.
/// Cost: four multiplies per component and a square root.
[[nodiscard]] constexpr Fixed norm(const Fixed* v, int n) noexcept {
    SPLINEFEED_ASSERT(n >= 0 && n <= 9);
    Wide sum{};
    for (int i = 0; i < n; ++i) {
        const std::uint64_t size = detail::magnitude(v[i].raw());
        SPLINEFEED_ASSERT((size >> 62) == 0);
        sum = add(sum, multiply(size, size)); // eight squares below 2^124 stay below 2^127
    }
    return Fixed::from_raw(detail::with_sign(square_root_rounded(sum), false).raw);
}

// ---- exact operations and comparisons

/// x * 2^exponent for |exponent| <= 100. Exact if the result is a normal number.
template <Floating S>
[[nodiscard]] constexpr S scale2(S x, int exponent) noexcept {
    SPLINEFEED_ASSERT(exponent >= -100 && exponent <= 100);
    return x * detail::power_of_two<S>(exponent);
}

/// x * 2^exponent rounded to nearest, ties away from zero: error <= 1/2 ulp. Saturates. Any exponent is allowed.
[[nodiscard, gnu::always_inline]] constexpr Fixed scale2(Fixed x, int exponent) noexcept {
    return Fixed::from_raw(detail::shifted(x.raw(), exponent));
}

/// x / 2, rounded as by scale2.
template <Numeric N>
[[nodiscard, gnu::always_inline]] constexpr N half(N x) noexcept {
    return scale2(x, -1);
}

/// (a + b) / 2
template <Floating S>
[[nodiscard, gnu::always_inline]] constexpr S mean(S a, S b) noexcept {
    return half(a + b);
}

/// factor * x.
template <Floating S>
[[nodiscard, gnu::always_inline]] constexpr S times(int factor, S x) noexcept {
    return static_cast<S>(factor) * x;
}

/// factor * x, exact; saturates.
[[nodiscard]] constexpr Fixed times(int factor, Fixed x) noexcept {
    // Between -2^15 and 2^15, as nearly all are, times a small factor.
    const bool fits = (static_cast<std::uint32_t>(detail::upper_word(x.raw())) + 0x8000U) >> 16 == 0 &&
                      (static_cast<unsigned>(factor) + 0x4000U) >> 15 == 0;
    return Fixed::from_raw(fits ? x.raw() * factor : detail::product(Fixed(factor).raw(), x.raw()));
}

/// x|, exact. Fixed::lowest() has no positive counterpart: it overflows to the largest number.
template <Scalar S>
[[nodiscard]] constexpr S absolute(S x) noexcept {
    return x < S{} ? -x : x;
}

/// The smaller of two numbers.
template <typename S>
requires Numeric<S> || std::integral<S>
[[nodiscard]] constexpr S smaller(S a, S b) noexcept {
    return b < a ? b : a;
}

/// The larger of two numbers.
template <typename S>
requires Numeric<S> || std::integral<S>
[[nodiscard]] constexpr S larger(S a, S b) noexcept {
    return a < b ? b : a;
}

/// a / b for a >= 0 and b >= 0; the largest number if b is zero or the quotient does not fit. Error <= 1/2 ulp, except
/// that a quotient within 1 ulp of the largest number may become the largest number.
template <Floating S>
[[nodiscard]] constexpr S quotient_or_max(S a, S b) noexcept {
    SPLINEFEED_ASSERT(a >= S{0} && b >= S{0});
    // Not left to the rules of infinity: a division that overflows is not a constant expression, and 0/0 would be NaN.
    // For b >= 1 nothing overflows. For b < 1 the product does not overflow, and its rounding does not matter at this
    // size.
    if (b < S{1} && a >= b * largest<S>()) {
        return largest<S>();
    }
    return a / b;
}

/// a / b for a >= 0 and b >= 0; the largest number if b is zero or the quotient does not fit. Error <= 1/2 ulp.
[[nodiscard]] constexpr Fixed quotient_or_max(Fixed a, Fixed b) noexcept {
    SPLINEFEED_ASSERT(a.raw() >= 0 && b.raw() >= 0);
    return Fixed::from_raw(detail::quotient(a.raw(), b.raw()));
}

// ---- conversions

/// An integer as a number of N. Exact, except in float from 2^24 on: rounded to nearest. @pre it is in the range of N
template <Numeric N>
[[nodiscard]] constexpr N from_integer(std::int32_t value) noexcept {
    if constexpr (Scalar<N>) {
        return static_cast<N>(value);
    } else {
        return N::from_raw(detail::word_of(value, N::fraction_bits));
    }
}

/// x * 2^log2 as an N: rounded to nearest, ties away from zero; saturates. In float and double N is S.
template <Numeric N, Scalar S>
[[nodiscard, gnu::always_inline]] constexpr N shortened(S x, int log2 = 0) noexcept {
    if constexpr (std::same_as<N, S>) {
        return scale2(x, log2);
    } else {
        return N::from_raw(detail::word_of(x.raw(), log2 + N::fraction_bits - detail::fixed_fraction_bits));
    }
}

/// The same of a result that is known to fit, |log2| <= 29.
template <Numeric N, Scalar S>
[[nodiscard, gnu::always_inline]] constexpr N shortened_to_fit(S x, int log2) noexcept {
    if constexpr (std::same_as<N, S>) {
        return scale2(x, log2);
    } else {
        return N::from_raw(detail::fitting_word(x.raw(), log2 + N::fraction_bits - detail::fixed_fraction_bits));
    }
}

/// The reverse: x * 2^log2 as an S.
template <Scalar S, Numeric N>
[[nodiscard, gnu::always_inline]] constexpr S lengthened(N x, int log2 = 0) noexcept {
    if constexpr (std::same_as<N, S>) {
        return scale2(x, log2);
    } else {
        return S::from_raw(detail::shifted(x.raw(), log2 + detail::fixed_fraction_bits - N::fraction_bits));
    }
}

/// The nearest number of N, for the host only: on a microcontroller it would need arithmetic in double. @pre value is
/// in the range of N
template <Numeric N>
[[nodiscard]] constexpr N from_double(double value) noexcept {
    if constexpr (Floating<N>) {
        return static_cast<N>(value);
    } else {
        return N::from_double(value);
    }
}

/// The value as an R: rounded to nearest. Exact in double, except for Fixed from 2^21 on.
template <Floating R, Numeric N>
[[nodiscard]] constexpr R to_floating(N value) noexcept {
    if constexpr (Floating<N>) {
        return static_cast<R>(value);
    } else if constexpr (std::same_as<R, double>) {
        return value.to_double();
    } else {
        return detail::from_integer_scaled<R>(value.raw(), -N::fraction_bits);
    }
}

/// The value as a double.
template <Numeric N>
[[nodiscard]] constexpr double to_double(N value) noexcept {
    return to_floating<double>(value);
}

/// The value as an N: itself, or a number with a floating point.
template <Numeric N, Numeric M>
[[nodiscard]] constexpr N converted(M value) noexcept {
    if constexpr (std::same_as<N, M>) {
        return value;
    } else {
        return to_floating<N>(value);
    }
}

/// The number of N nearest to a constant, computed by the compiler: `literal<S>(0.25)`.
template <Numeric N>
[[nodiscard]] consteval N literal(double value) noexcept {
    return from_double<N>(value);
}

/// "double", "float" or "fixed".
template <Scalar S>
[[nodiscard]] constexpr const char* scalar_name() noexcept {
    return std::same_as<S, double> ? "double" : std::same_as<S, float> ? "float" : "fixed";
}

} // namespace splinefeed
