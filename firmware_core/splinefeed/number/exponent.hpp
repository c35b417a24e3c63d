// SPDX-License-Identifier: MIT
// The binary exponent of a number, used to choose a power of two as unit.
#pragma once

#include "splinefeed/number/scalar.hpp"

#include <bit>

namespace splinefeed {

/// floor(log2(x)) for x > 0 (float and double: normal numbers). Exact. Cost: a shift, or a count of leading zeros.
template <Scalar S>
[[nodiscard]] constexpr int exponent_of(S x) noexcept {
    SPLINEFEED_ASSERT(x > S{});
    if constexpr (std::same_as<S, double>) {
        return static_cast<int>(std::bit_cast<std::uint64_t>(x) >> 52U) - 1023;
    } else if constexpr (std::same_as<S, float>) {
        return static_cast<int>(std::bit_cast<std::uint32_t>(x) >> 23U) - 127;
    } else {
        return 63 - std::countl_zero(static_cast<std::uint64_t>(x.raw())) - 32;
    }
}

} // namespace splinefeed
