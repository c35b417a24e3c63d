// SPDX-License-Identifier: MIT
// Cell: a piece of the curve, so short that one polynomial inverts its arc length and one bound each is enough for its
// direction and its curvature. It holds its own geometry: later stages never need the curve.
#pragma once

#include "splinefeed/base/capacity.hpp"
#include "splinefeed/number/position.hpp"
#include "splinefeed/number/scalar.hpp"

#include <cstdint>

namespace splinefeed {

/// How an axis moves along a cell of length L: dq/ds, a cubic given by its values and slopes at both ends, and 2 L
/// d2q/ds2, a parabola.
template <Scalar S>
struct AxisShape {
    /// What rounding is allowed for in `bend`, and is part of `error_bound`. Most comes from the inverse: it misses
    /// w = 1/2 by up to two roundings of 2^-30, of which the second derivative is 24 times as large.
    /// Nothing like it is lost in double, which allows for as much, so that both plan alike.
    static constexpr Ratio<S> rounding = literal<Ratio<S>>(std::same_as<S, float> ? 0.0 : 0x1p-23);

    std::array<Ratio<S>, 2> tangent{}; ///< dq/ds at both ends
    std::array<Ratio<S>, 3> bend{};    ///< Bezier points of 2 L d2q/ds2
    Ratio<S> error_bound{}; ///< times v0^2 + v1^2 it bounds the error that these polynomials cause in 2 L times an
                            ///< acceleration

    /// The part of `error_bound` by which the shape of the curve differs from these polynomials, so that their
    /// derivatives differ, too. Rounding moves no point by more than 2^-29 of the cell: no sample shows its
    /// derivatives.
    [[nodiscard]] Ratio<S> shape_error() const noexcept { return larger(error_bound - rounding, Ratio<S>{}); }
};

template <Scalar S>
struct Cell {
    static constexpr double sharp_turn = 0.5003; ///< 2 length_mm curvature_max of a cell that is not fine

    int axes = 0;
    int degree = 0;
    int unit_log2 = 0;
    /// Direction in which an axis moves in the cell and near it, 1 or -1; otherwise it may turn round there (Turning).
    PerAxis<std::int8_t> heading{};
    PerAxis<Position> origin{};
    PerAxis<Position> end{};           ///< the exact end point; meaningful if stop_at_end
    PerAxis<PerDegree<S>> power{};     ///< offset = sum power[axis][i] w^i, w in [0, 1], in units of 2^unit_log2 mm
    std::array<Ratio<S>, 6> inverse{}; ///< w = x + sum inverse[i] x^(i+1) / 4, x = s / length_mm; their sum is 0
    S length_mm{};
    S measured_mm{}; ///< length of the cell whose shape was measured: this one, or the one that it is a part of
    PerAxis<Ratio<S>> tangent_max{}; ///< bound of |dq/ds| over the cell, at most 1
    PerAxis<S> curvature_max{};      ///< bound of |d2q/ds2| over the cell [1/mm]
    PerAxis<AxisShape<S>> shape{};
    S feed_mm_s{};                ///< programmed feed; 0: the machine's feed; or rapid_feed
    S max_feed_mm_s{};            ///< upper limit for every feed override; 0: none
    S steady_mm_s{};              ///< largest speed at which rounding at the cell's ends causes no jump above
                                  ///< Refinement::jump_mm_s
    bool feed_along_path = false; ///< both feeds count all axes
    bool stop_before = false;     ///< a cusp lies before this cell: the cell before has to end at standstill
    bool stop_at_end = false;
    std::uint32_t waypoint = 0;

    /// Position at the fraction x in [0, 1] of the cell's length, in X: S, or double. Cost: 6 + degree * axes products.
    template <Scalar X>
    void position_at(X x, PerAxis<Position>& out) const noexcept;
    /// dq/ds at the same place, by the polynomial. Cost: a root, and as many products again.
    template <Scalar X>
    void direction_at(X x, PerAxis<X>& out) const noexcept;
    /// Curve parameter w at the fraction x of the cell's length.
    template <Scalar X>
    [[nodiscard]] X parameter_at(X x) const noexcept;
};

} // namespace splinefeed
