// SPDX-License-Identifier: MIT
// Angles in radians, by series that need only sums, products and square roots: the same on every target.
#pragma once

#include "splinefeed/number/scalar.hpp"

namespace splinefeed {

/// sin(x) for |x| <= 0.6. Error below 3e-13 and a few ulp. Cost: seven products.
template <Scalar S>
[[nodiscard]] constexpr S small_sine(S x) noexcept {
    const S square = x * x;
    S sum = literal<S>(-1.0 / 39916800.0);
    sum = literal<S>(1.0 / 362880.0) + square * sum;
    sum = literal<S>(-1.0 / 5040.0) + square * sum;
    sum = literal<S>(1.0 / 120.0) + square * sum;
    sum = literal<S>(-1.0 / 6.0) + square * sum;
    return x + x * (square * sum);
}

/// 1 - cos(x) for |x| <= 0.6. Error below 1e-14 and a few ulp of the result; nothing cancels. Cost: seven products.
template <Scalar S>
[[nodiscard]] constexpr S small_versine(S x) noexcept {
    const S square = x * x;
    S sum = literal<S>(-1.0 / 479001600.0);
    sum = literal<S>(1.0 / 3628800.0) + square * sum;
    sum = literal<S>(-1.0 / 40320.0) + square * sum;
    sum = literal<S>(1.0 / 720.0) + square * sum;
    sum = literal<S>(-1.0 / 24.0) + square * sum;
    return scale2(square, -1) + square * (square * sum);
}

namespace detail {

/// atan(t) for |t| <= 1: halved twice, then a series to t^17.
template <Scalar S>
[[nodiscard]] constexpr S arc_tangent(S t) noexcept {
    const S one = from_integer<S>(1);
    for (int halving = 0; halving < 2; ++halving) {
        t = t / (one + square_root(one + t * t));
    }
    const S square = t * t;
    S sum = literal<S>(1.0 / 17.0);
    for (const S term :
         {literal<S>(-1.0 / 15.0), literal<S>(1.0 / 13.0), literal<S>(-1.0 / 11.0), literal<S>(1.0 / 9.0),
          literal<S>(-1.0 / 7.0), literal<S>(1.0 / 5.0), literal<S>(-1.0 / 3.0)}) {
        sum = term + square * sum;
    }
    return scale2(t + t * (square * sum), 2);
}

} // namespace detail

/// The angle of the vector (cosine, sine), from -pi to pi; 0 for the zero vector. The components may have any common
/// factor up to 2^29. Error: a few ulp of S near 1. Cost: three divisions and two square roots.
template <Scalar S>
[[nodiscard]] constexpr S angle_of(S cosine, S sine) noexcept {
    const S along = absolute(cosine);
    const S across = absolute(sine);
    if (!(along > S{}) && !(across > S{})) {
        return S{};
    }
    S angle = across > along ? literal<S>(1.5707963267948966) - detail::arc_tangent(along / across)
                             : detail::arc_tangent(across / along);
    if (cosine < S{}) {
        angle = literal<S>(3.14159265358979323846) - angle;
    }
    return sine < S{} ? -angle : angle;
}

} // namespace splinefeed
