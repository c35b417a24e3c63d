// SPDX-License-Identifier: MIT
//
// The value of a scalar, without rounding.
#pragma once

#include "splinefeed/number/scalar.hpp"

#include <cmath>
#include <concepts>

namespace splinefeed_test {

using Real = long double;

template <splinefeed::Numeric S>
Real exact(S x) {
    if constexpr (std::same_as<S, splinefeed::Fixed>) {
        return std::ldexp(static_cast<Real>(x.raw()), -32);
    } else if constexpr (std::same_as<S, splinefeed::ShortFixed>) {
        return std::ldexp(static_cast<Real>(x.raw()), -30);
    } else {
        return static_cast<Real>(x);
    }
}

} // namespace splinefeed_test
