// SPDX-License-Identifier: MIT
// Knot insertion: the same curve with more knots, down to the Bezier points of its pieces.
//
// W. Boehm, "Inserting new knots into B-spline curves" (1980); Sakude uses it to bring sections to one knot vector. All
// results are convex combinations of control points: nothing leaves their range, in Fixed neither.
#pragma once

#include "splinefeed/splines/bezier_piece.hpp"

#include <cstddef>
#include <span>

namespace splinefeed {

/// A curve whose knots and control points are about to become more: arrays with room behind the `_count` used ones.
template <Scalar S>
struct GrowingCurve {
    int degree = 3;
    int axes = 3;
    std::size_t knot_count = 0; ///< control points: knot_count - degree - 1
    std::span<S> knots{};
    std::span<Point<S>> controls{};
};

/// Inserts the knot t once; the curve stays what it is. Open curves, t inside the domain.
/// Errors: storage_too_small; knots_invalid (t outside the domain or at its ends, or already there `degree` times: once
/// more would cut the curve). Cost: degree combinations, and moving what lies behind t.
template <Scalar S>
Status insert_knot(GrowingCurve<S>& curve, S t) noexcept;

/// Inserts all that `finer` has more than the curve's knots, which it must hold, each at least as often.
/// Errors: storage_too_small; knots_invalid (not a refinement, or see insert_knot). Cost: insert_knot each.
template <Scalar S>
Status refine_knots(GrowingCurve<S>& curve, std::span<const S> finer) noexcept;

/// The Bezier piece over [knots[span], knots[span+1]]. Control points repeat modulo their number: open and closed
/// curves alike. Cost: degree^2 combinations an axis. @pre knots[span] < knots[span+1], degree <= span < number of
/// knots - degree - 1
template <Scalar S>
[[nodiscard]] BezierPiece<S> bezier_piece(std::span<const S> knots, int degree, std::span<const Point<S>> controls,
                                          int axes, std::size_t span) noexcept;

/// Number of non-empty spans: of the Bezier pieces of a curve.
template <Scalar S>
[[nodiscard]] std::size_t bezier_piece_count(std::span<const S> knots, int degree) noexcept;

/// All Bezier pieces in order, and in breaks (one more than pieces) where they begin and end. Where the knot between
/// two pieces repeats at most `degree` times both have the same point there, bit by bit; the same holds for the ends of
/// a closed curve. Errors: storage_too_small.
template <Scalar S>
Status bezier_pieces(std::span<const S> knots, int degree, std::span<const Point<S>> controls, int axes, bool closed,
                     std::span<BezierPiece<S>> pieces, std::span<S> breaks) noexcept;

} // namespace splinefeed
