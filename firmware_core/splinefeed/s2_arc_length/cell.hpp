// SPDX-License-Identifier: MIT
// Cell: a piece of the curve short enough that one polynomial inverts its arc length and one bound each describes its
// direction and curvature. It carries its own geometry, so nothing downstream looks back at the curve.
#pragma once

#include "splinefeed/base/capacity.hpp"
#include "splinefeed/number/position.hpp"
#include "splinefeed/number/scalar.hpp"

#include <cstdint>

namespace splinefeed {

template <Scalar S>
struct Cell {
    int axes = 0;
    int degree = 0;
    int unit_log2 = 0;
    PerAxis<Position> origin{};
    PerAxis<Position> end{};       ///< the exact target, meaningful where stop_at_end
    PerAxis<PerDegree<S>> power{}; ///< offset = sum power[axis][i] w^i, w in [0, 1], in units of 2^unit_log2 mm
    std::array<S, 6> inverse{};    ///< w = sum inverse[i] x^(i+1), x = s / length_mm
    S length_mm{};
    PerAxis<S> tangent_max{};   ///< bound of |dq/ds| over the cell, at most 1
    PerAxis<S> curvature_max{}; ///< bound of |d2q/ds2| over the cell [1/mm]
    S feed_mm_s{};              ///< programmed feed; 0: the machine's
    S direction_noise{};        ///< rounding of the direction and speed at its ends, relative
    bool stop_before = false;   ///< a cusp lies before it: the cell before has to end at rest
    bool stop_at_end = false;
    std::uint32_t waypoint = 0;

    /// Position at the fraction x in [0, 1] of the cell's length. Cost: 6 + degree * axes products.
    void position_at(S x, PerAxis<Position>& out) const noexcept;
    /// Curve parameter w at the fraction x of the cell's length.
    [[nodiscard]] S parameter_at(S x) const noexcept;
};

} // namespace splinefeed
