// SPDX-License-Identifier: MIT
//
// The value of a scalar, without rounding.
#pragma once

#include "splinefeed/number/scalar.hpp"

#include <cmath>
#include <concepts>

namespace splinefeed_test {

using Real = long double;

template <splinefeed::Scalar S>
Real exact(S x) {
    if constexpr (std::same_as<S, splinefeed::Fixed>) {
        return std::ldexp(static_cast<Real>(x.raw()), -32);
    } else {
        return static_cast<Real>(x);
    }
}

} // namespace splinefeed_test
