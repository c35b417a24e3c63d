// SPDX-License-Identifier: MIT
// CellInterval: a part of a cell, and what is left of a polynomial on it.
#pragma once

#include "splinefeed/number/scalar.hpp"

#include <array>
#include <cstddef>

namespace splinefeed {

/// From one fraction of a cell's length to another.
template <Scalar S>
struct CellInterval {
    S from{};
    S to = from_integer<S>(1);

    [[nodiscard]] S length() const noexcept { return to - from; }
    [[nodiscard]] bool whole() const noexcept { return from == S{} && to == from_integer<S>(1); }
};

/// Bezier points on the stretch of the polynomial with these on the cell: the blossom at its ends (de Casteljau).
/// Convex combinations: what holds for the points of the cell holds for those of a stretch.
template <Scalar S, std::size_t N>
[[nodiscard]] std::array<S, N> points_on(const CellInterval<S>& stretch, const std::array<S, N>& points) noexcept {
    std::array<S, N> out{};
    for (std::size_t i = 0; i < N; ++i) {
        std::array<S, N> d = points;
        for (std::size_t r = 1; r < N; ++r) {
            const S w = r + i < N ? stretch.from : stretch.to;
            for (std::size_t j = 0; j + r < N; ++j) {
                d[j] = d[j] + (d[j + 1] - d[j]) * w;
            }
        }
        out[i] = d[0];
    }
    return out;
}

} // namespace splinefeed
