// SPDX-License-Identifier: MIT
// product_fits: a test before a product of input data, where an overflow means bad data and not a broken precondition.
#pragma once

#include "splinefeed/number/scalar.hpp"

namespace splinefeed {

/// Whether a b fits in S with two bits to spare; a, b >= 0. false for NaN.
template <Scalar S>
[[nodiscard]] constexpr bool product_fits(S a, S b) noexcept {
    return a <= quotient_or_max(scale2(largest<S>(), -2), b);
}

} // namespace splinefeed
