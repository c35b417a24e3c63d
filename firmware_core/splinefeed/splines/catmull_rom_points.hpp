// SPDX-License-Identifier: MIT
// catmull_rom_points: the original Catmull-Rom curve, if all points are known.
#pragma once

#include "splinefeed/splines/bezier_piece.hpp"

namespace splinefeed {

// ---- arithmetic of a segment, shared with CurveSource CatmullRom

/// A chord and its interval of the curve parameter.
template <Scalar S>
struct SpannedChord {
    const Point<S>* vector = nullptr; ///< null: there is none, the curve ends here
    S span{};                         ///< > 0
};

/// The tangent at a point. by_span: its derivative by the curve parameter. Otherwise a third of the tangent by the
/// parameter of either segment in [0, 1], which needs no span.
template <Scalar S>
struct KnotTangent {
    Point<S> vector{};
    bool by_span = false;
};

/// Between equal spans m (P_{i+1} - P_{i-1}), Borysenko & Ustenko (3). Otherwise 2 m times the derivative of
/// the parabola through the three points. At an end of the curve m times the chord, whatever the spans. Error: 3
/// roundings of the tangent, by span 8. Cost: one division per axis, by span two.
/// @pre |chord| < 2^29 in Fixed
template <Scalar S>
void catmull_rom_tangent(const SpannedChord<S>& before, const SpannedChord<S>& after, S tension, int axes,
                         KnotTangent<S>& out) noexcept;

/// The inner Bezier points of a segment as offsets from its start: a third of the tangents at its ends.
template <Scalar S>
void catmull_rom_legs(const SpannedChord<S>& chord, const KnotTangent<S>& start, const KnotTangent<S>& end, int axes,
                      Point<S>& leg_in, Point<S>& leg_out) noexcept;

// ---- the whole curve

/// Number of pieces of a curve through `count` points.
[[nodiscard]] constexpr std::size_t pieces_through(std::size_t count, bool closed) noexcept {
    return closed ? count : count - 1;
}

/// Tangents m (P_{i+1} - P_{i-1}) and the cubics between the points, Borysenko & Ustenko (2)-(5). At the ends the end
/// points count twice: r' = m (P_1 - P_0), along P0P1 and P2P3 (printed: P3P4). The tangents are parallel to P0P2 and
/// P1P3 (printed: P0P1 and P2P3), and b_x has -m (x3 - x1) (printed: plus). Interpolates. Class C1. m = 0 gives the
/// polygon, with a zero tangent at every point; a reversal between equal chords also gives a zero tangent: C1 with a
/// singular point. Neighbours may coincide: the result is a small loop, or a stop. Bezier points leave the box of the
/// points by at most (m/3) of its size. CatmullRom with Parameterization::uniform is the streaming form, bit for bit if
/// the points are exact. Errors: too_few_points (2 open, 3 closed), position_out_of_range (NaN, infinity, beyond 2^25
/// in Fixed, otherwise 2^40), tension_out_of_range (not 0 to 10; m < 0 would reverse tangents), storage_too_small.
/// Cost: 2 products and 2 divisions per point and axis.
/// @param closed    a piece leads from the last point to the first; the first point is not repeated
/// @param tangents  one per point
/// @param pieces    pieces_through(points.size(), closed)
template <Scalar S>
[[nodiscard]] Status catmull_rom_points(std::span<const Point<S>> points, int axes, bool closed, S tension,
                                        std::span<Point<S>> tangents, std::span<BezierPiece<S>> pieces) noexcept;

} // namespace splinefeed
