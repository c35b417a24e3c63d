// SPDX-License-Identifier: MIT
// Weights: basis functions, ratios of knot spans and multipliers of an elimination: numbers of about 1.
//
// A Fixed near 1 has 32 bits, of which a system of equations of condition 1e5 would leave 15. So in Fixed weights are
// stored in units of 2^-14, which gives them 46 bits; in double and float the unit is 1. Products of two weights do not
// overflow if they stay below 8.
#pragma once

#include "splinefeed/number/scalar.hpp"

namespace splinefeed {

/// A weight is held in units of 2^-weight_log2.
template <Scalar S>
inline constexpr int weight_log2 = std::same_as<S, Fixed> ? 14 : 0;

/// The weight 1.
template <Scalar S>
[[nodiscard]] constexpr S weight_one() noexcept {
    return from_integer<S>(std::int32_t{1} << weight_log2<S>);
}

/// The weight a / b; or a value a divided by a weight b, which is the same operation. In Fixed |a| < 2^30 and |a / b| <
/// 2^15; the error is below 2^-32 + 2^-19 / |b| for |a| >= 2^16, otherwise it is half an ulp.
template <Scalar S>
[[nodiscard]] constexpr S weight_ratio(S a, S b) noexcept {
    if constexpr (std::same_as<S, Fixed>) {
        if (absolute(a) < from_integer<S>(1 << 16)) {
            return scale2(a, weight_log2<S>) / b;
        }
        const S quotient = a / b; // the digits that follow come from the remainder
        return scale2(quotient, weight_log2<S>) + scale2(a - quotient * b, weight_log2<S>) / b;
    } else {
        return a / b;
    }
}

/// The product of two weights, as a weight. In Fixed: error <= 1 ulp.
template <Scalar S>
[[nodiscard]] constexpr S weight_product(S a, S b) noexcept {
    if constexpr (std::same_as<S, Fixed>) {
        return scale2(a * b, -weight_log2<S>);
    } else {
        return a * b;
    }
}

/// A value times a weight. In Fixed: error <= 1 ulp + 2^-19 |value| 2^-14 ulp; the result must be in range.
template <Scalar S>
[[nodiscard]] constexpr S weighted(S weight, S value) noexcept {
    if constexpr (std::same_as<S, Fixed>) {
        const S coarse = scale2(weight, -weight_log2<S>);
        const S rest = weight - scale2(coarse, weight_log2<S>);
        return coarse * value + scale2(rest * value, -weight_log2<S>);
    } else {
        return weight * value;
    }
}

} // namespace splinefeed
