// SPDX-License-Identifier: MIT
// The modified Catmull-Rom curve: cubic Hermite segments whose tangents are derivatives by chord length.
//
// Borysenko & Ustenko, "Modification of Catmull-Rom spline curves": the derivative R'(s) at a point is that of the
// parabola through three points, where s is the sum of chord lengths. Errors in print that are not followed:
// - s_i is the sum of the chords up to P_i and h_i the length of one chord; the text calls both the length;
// - the one-sided formulas are labelled R'_x(s_i) and R'_y(s_i). They belong to s_{i-1} and s_{i+1}, the second one
//   in x. Its weights must be delta, -(1+delta)^2/delta, (1+2 delta)/delta (printed: plus sign, other last weight;
//   their sum is not 0, so the printed derivative depends on the origin);
// - the right difference uses P1, P2, P3; with "P2, P3, P4" and P4 = P3 it divides by zero;
// - a closed curve P_0 ... P_n has P_{-1} = P_n, P_{n+1} = P_0, P_{n+2} = P_1 (printed: P_{n+2} = P_0);
// - dR/dt on a segment is R'(s) ds/dt: a factor with the dimension of a length, which the text omits. "m must exceed 1"
//   only means that its chords were longer than one unit.
#pragma once

#include "splinefeed/splines/bezier_piece.hpp"

#include <cstddef>

namespace splinefeed {

/// ds/dt of a segment with t in [0, 1].
enum class ChordFactor : std::uint8_t {
    constant, ///< the factor, a length, everywhere: the article's m. C1; the shape depends on the unit
    chord,    ///< the factor, a tension, times the chord of the segment. G1 in t, C1 in s; the same in every unit
};

/// A chord and its length, which is > 0.
template <Scalar S>
struct Chord {
    Point<S> vector{};
    S length{};
};

template <Scalar S>
struct ModifiedTangents {
    ChordFactor mode = ChordFactor::chord;
    S factor = literal<S>(1); ///< chord: 0 (polygon) to 2. constant: a length, 0 to 2^20 in the unit of the points
};

// ---- arithmetic of a segment, shared with CurveSource CatmullRomModified

/// R'(s) between two chords, (h_2 u_1 + h_1 u_2)/(h_1 + h_2) with unit chords u (the article's central difference,
/// which is printed correctly). |R'| <= 1. Error: a few roundings of 1.
template <Scalar S>
[[nodiscard]] Point<S> central_slope(const Chord<S>& before, const Chord<S>& after) noexcept;

/// R'(s) at the start of `first`, 2 u_1 - central. |R'| <= 3.
template <Scalar S>
[[nodiscard]] Point<S> left_slope(const Chord<S>& first, const Chord<S>& second) noexcept;

/// R'(s) at the end of `second`, 2 u_2 - central: the article's second one-sided formula as corrected.
template <Scalar S>
[[nodiscard]] Point<S> right_slope(const Chord<S>& first, const Chord<S>& second) noexcept;

/// u, the slope if there is no third point.
template <Scalar S>
[[nodiscard]] Point<S> only_slope(const Chord<S>& chord) noexcept;

/// The inner Bezier points of a segment as offsets from its start: R' ds/dt / 3 from each end.
template <Scalar S>
void modified_legs(const Chord<S>& chord, const Point<S>& start_slope, const Point<S>& end_slope,
                   const ModifiedTangents<S>& tangents, Point<S>& leg_in, Point<S>& leg_out) noexcept;

// ---- the whole curve

/// Output of modified_catmull_rom; each span has at least as many entries as there are points (closed: segments).
template <Scalar S>
struct ModifiedCurve {
    std::span<S> chords;              ///< h_i, one per segment
    std::span<Point<S>> derivatives;  ///< R'(s_i), one per point
    std::span<BezierPiece<S>> pieces; ///< one per segment
};

/// Makes the curve through the points and returns its number of segments. Interpolates. Local. Class: see ChordFactor.
/// If a tangent vanishes (factor 0, a reversal between equal chords) the curve is C1 with a singular point: tangent and
/// curvature are undefined. Open ends use one-sided differences: first and last segments are the parabola through three
/// points (chord factor 1); three points give one parabola, two a straight line. Closed: at least three points; a
/// repeated closing point is dropped. Errors: too_few_points, position_out_of_range (NaN, infinity, beyond
/// farthest_coordinate), coincident_points (two neighbours at distance 0: the difference divides by it; merge them
/// first), factor_out_of_range, storage_too_small. Cost: per point two divisions per axis and a square root.
template <Scalar S>
[[nodiscard]] Result<std::size_t> modified_catmull_rom(std::span<const Point<S>> points, bool closed,
                                                       const ModifiedTangents<S>& tangents,
                                                       const ModifiedCurve<S>& out) noexcept;

} // namespace splinefeed
