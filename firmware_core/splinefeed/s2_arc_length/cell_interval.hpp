// SPDX-License-Identifier: MIT
// CellInterval: a part of a cell, and the polynomials of the cell restricted to it.
#pragma once

#include "splinefeed/number/scalar.hpp"

#include <array>
#include <cstddef>

namespace splinefeed {

/// A part of a cell, between two fractions of the cell's length.
template <Scalar S>
struct CellInterval {
    S from{};
    S to = from_integer<S>(1);

    [[nodiscard]] S length() const noexcept { return to - from; }
    [[nodiscard]] bool whole() const noexcept { return from == S{} && to == from_integer<S>(1); }
};

/// Given the Bezier points of a polynomial on the cell, returns its Bezier points on a part of it: the blossom at the
/// ends of the part (de Casteljau). These are convex combinations: a bound that holds for the points of the cell also
/// holds for those of the part.
template <Scalar S, std::size_t N>
[[nodiscard]] std::array<Ratio<S>, N> points_on(const CellInterval<S>& stretch,
                                                const std::array<Ratio<S>, N>& points) noexcept {
    const auto from = shortened<Ratio<S>>(stretch.from);
    const auto to = shortened<Ratio<S>>(stretch.to);
    std::array<Ratio<S>, N> out{};
    for (std::size_t i = 0; i < N; ++i) {
        std::array<Ratio<S>, N> d = points;
        for (std::size_t r = 1; r < N; ++r) {
            const Ratio<S> w = r + i < N ? from : to;
            for (std::size_t j = 0; j + r < N; ++j) {
                d[j] = d[j] + (d[j + 1] - d[j]) * w;
            }
        }
        out[i] = d[0];
    }
    return out;
}

} // namespace splinefeed
