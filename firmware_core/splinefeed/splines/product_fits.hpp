// SPDX-License-Identifier: MIT
// product_fits: what is asked before a product of data, where an overflow would be bad data and not a broken
// precondition.
#pragma once

#include "splinefeed/number/scalar.hpp"

namespace splinefeed {

/// Whether a b is a number of S with two bits to spare; a, b >= 0. NaN is not.
template <Scalar S>
[[nodiscard]] constexpr bool product_fits(S a, S b) noexcept {
    return a <= quotient_or_max(scale2(largest<S>(), -2), b);
}

} // namespace splinefeed
