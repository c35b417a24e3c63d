// SPDX-License-Identifier: MIT
// Pair: two numbers that are computed at once, where the processor can.
#pragma once

#include "splinefeed/number/floating.hpp"

#include <bit>
#include <cstdint>

namespace splinefeed {

namespace detail {
template <Floating R>
struct PairOf;
template <>
struct PairOf<float> {
    using Bits [[gnu::vector_size(8)]] = int;
    using Type [[gnu::vector_size(8)]] = float;
    static constexpr Bits sign{INT32_MIN, INT32_MIN};
};
template <>
struct PairOf<double> {
    using Bits [[gnu::vector_size(16)]] = long long;
    using Type [[gnu::vector_size(16)]] = double;
    static constexpr Bits sign{INT64_MIN, INT64_MIN};
};
} // namespace detail

/// Two numbers, with + - * / and comparisons of each by itself. The results are those of single numbers, bit for bit.
template <Floating R>
using Pair = typename detail::PairOf<R>::Type;

/// Both without their signs.
template <Floating R>
[[nodiscard, gnu::always_inline]] inline Pair<R> magnitude_of(Pair<R> x) noexcept {
    return std::bit_cast<Pair<R>>(std::bit_cast<typename detail::PairOf<R>::Bits>(x) & ~detail::PairOf<R>::sign);
}

/// x, its signs changed where those of the other pair are negative.
template <Floating R>
[[nodiscard, gnu::always_inline]] inline Pair<R> with_sign_of(Pair<R> x, Pair<R> other) noexcept {
    using Bits = typename detail::PairOf<R>::Bits;
    return std::bit_cast<Pair<R>>(std::bit_cast<Bits>(x) ^ (std::bit_cast<Bits>(other) & detail::PairOf<R>::sign));
}

/// The larger one.
template <Floating R>
[[nodiscard, gnu::always_inline]] inline R larger_of(Pair<R> x) noexcept {
    return x[0] < x[1] ? x[1] : x[0];
}

/// The sum of both.
template <Floating R>
[[nodiscard, gnu::always_inline]] inline R sum_of(Pair<R> x) noexcept {
    return x[0] + x[1];
}

} // namespace splinefeed
