// SPDX-License-Identifier: MIT
// Knot insertion: the same curve with more knots, down to the Bezier points of its pieces.
//
// W. Boehm, "Inserting new knots into B-spline curves" (1980); Sakude uses it to bring sections to one knot vector. All
// results are convex combinations of control points: nothing leaves their range, also in Fixed.
#pragma once

#include "splinefeed/splines/bezier_piece.hpp"

#include <cstddef>
#include <span>

namespace splinefeed {

/// A curve that gets more knots and control points: the arrays are longer than the used part, which `knot_count` gives.
template <Scalar S>
struct GrowingCurve {
    int degree = 3;
    int axes = 3;
    std::size_t knot_count = 0; ///< control points: knot_count - degree - 1
    std::span<S> knots{};
    std::span<Point<S>> controls{};
};

/// Inserts the knot t once; the curve does not change. For open curves, t inside the domain. Errors: storage_too_small;
/// knots_invalid (t outside the domain or at its ends, or there are already `degree` knots at t: one more would cut the
/// curve). Cost: degree combinations, and moving the entries after t.
template <Scalar S>
Status insert_knot(GrowingCurve<S>& curve, S t) noexcept;

/// Inserts all knots that `finer` has in addition to the curve's knots. `finer` must contain each of the curve's knots
/// at least as often. Errors: storage_too_small; knots_invalid (not a refinement, or see insert_knot). Cost: one
/// insert_knot per knot.
template <Scalar S>
Status refine_knots(GrowingCurve<S>& curve, std::span<const S> finer) noexcept;

/// The Bezier piece over [knots[span], knots[span+1]]. Control points repeat modulo their number, for open and closed
/// curves alike. Cost: degree^2 combinations per axis. @pre knots[span] < knots[span+1], degree <= span < number of
/// knots - degree - 1
template <Scalar S>
[[nodiscard]] BezierPiece<S> bezier_piece(std::span<const S> knots, int degree, std::span<const Point<S>> controls,
                                          int axes, std::size_t span) noexcept;

/// Number of non-empty spans: the number of Bezier pieces of a curve.
template <Scalar S>
[[nodiscard]] std::size_t bezier_piece_count(std::span<const S> knots, int degree) noexcept;

/// All Bezier pieces in order; `breaks` (one more than pieces) receives the parameters where they begin and end. If the
/// knot between two pieces repeats at most `degree` times, both have the same point there, bit for bit; this also holds
/// for the ends of a closed curve. Errors: storage_too_small.
template <Scalar S>
Status bezier_pieces(std::span<const S> knots, int degree, std::span<const Point<S>> controls, int axes, bool closed,
                     std::span<BezierPiece<S>> pieces, std::span<S> breaks) noexcept;

} // namespace splinefeed
