// SPDX-License-Identifier: MIT
// Algebra on arrays with a value for each axis, of which the first `count` are meaningful. The count is chosen at run
// time: operators over the whole capacity would cost a machine with three axes twice the arithmetic.
#pragma once

#include "splinefeed/base/indices.hpp"
#include "splinefeed/number/scalar.hpp"

#include <array>
#include <cstddef>

namespace splinefeed {

/// |v|, as norm of the scalar computes it.
template <Numeric N, std::size_t capacity>
[[nodiscard]] constexpr N norm(const std::array<N, capacity>& v, int count) noexcept {
    return norm(v.data(), count);
}

/// a . b, summed in the order of the axes.
template <Numeric N, std::size_t capacity>
[[nodiscard]] constexpr N dot(const std::array<N, capacity>& a, const std::array<N, capacity>& b, int count) noexcept {
    N sum{};
    for (const unsigned k : indices(count)) {
        sum += a[k] * b[k];
    }
    return sum;
}

/// a - b; 0 behind the count.
template <Numeric N, std::size_t capacity>
[[nodiscard]] constexpr std::array<N, capacity> difference(const std::array<N, capacity>& a,
                                                           const std::array<N, capacity>& b, int count) noexcept {
    std::array<N, capacity> out{};
    for (const unsigned k : indices(count)) {
        out[k] = a[k] - b[k];
    }
    return out;
}

} // namespace splinefeed
