// SPDX-License-Identifier: MIT
// g2_bezier: interpolation by cubic Bezier pieces that meet with continuous curvature, with bias and tension at each
// joint.
#pragma once

#include "splinefeed/splines/bezier_piece.hpp"

namespace splinefeed {

/// How the curve passes a point: r'(0) = beta1 q'(1), r''(0) = beta1^2 q''(1) + beta2 q'(1). Default: the ratio of the
/// chords and no tension, which at every joint is the C2 cubic spline by chord length.
template <Scalar S>
struct G2BezierJoint {
    bool chord_ratio = true;      ///< beta1 is |next chord| / |chord before|
    S beta1 = from_integer<S>(1); ///< bias otherwise, greater than 0
    S beta2{};                    ///< tension, 0 or more: pulls the tangent to zero and the curve to its chords
};

/// What is interpolated. Numbers of points and tangents lie axes by axes without gaps: 3-D takes half of the memory
/// that Point would, and memory is what long curves cost.
template <Scalar S>
struct G2BezierInput {
    int axes = 3;
    bool closed = false;            ///< a piece leads from the last point to the first; at least 3 points
    std::span<const S> coordinates; ///< axes numbers a point, at least 2 points
    /// One a joint (open: points 1 to n - 2; closed: points 0 to n - 1); one for all; or none: the default.
    std::span<const G2BezierJoint<S>> joints;
    std::span<const S>
        start;              ///< derivative of the first piece at its start, `axes` numbers; empty: natural, r''(0) = 0
    std::span<const S> end; ///< of the last piece at its end

    [[nodiscard]] std::size_t point_count() const noexcept {
        return axes > 0 ? coordinates.size() / static_cast<std::size_t>(axes) : 0;
    }
};

/// Solves for the tangents: tangents[i] is the derivative at the end of the piece that leads to point i, by its own
/// parameter, and beta1 times it that of the next one's start; tangents[0] of an open curve is the derivative at its
/// start. Class G2 of the curvature vector at every joint, C2 by chord length with the defaults. The constraint is
/// Barsky & DeRose's with beta1^2 at q'' (the print has beta1 there). Regular for every beta1 > 0 and beta2 >= 0 where
/// the curve is open, or closed with the chord ratio; a closed curve whose beta1 do not multiply to 1 may be singular
/// (system_singular; so is beta1 = 2.618 at every joint of an even number). A beta1 beyond 0.382 to 2.618 at every
/// joint without tension makes a curve whose tangents grow from joint to joint. Refuses coincident points where a chord
/// ratio is asked, beta1 <= 0, beta2 < 0, NaN; result_out_of_range where a tangent is beyond the range of S, in Fixed
/// also where neighbouring chords differ 2^20 times.
/// @param tangents  as many numbers as coordinates
/// @param scratch   one number a point
/// Cost: one forward and one backward pass, closed one forward pass more; no memory but the scratch. Derivation and why
/// no pivoting is needed: g2_bezier.cpp.
template <Scalar S>
Status g2_bezier_tangents(const G2BezierInput<S>& input, std::span<S> tangents, std::span<S> scratch) noexcept;

/// The pieces, open n - 1, closed n, from what g2_bezier_tangents made of the same input.
template <Scalar S>
Status g2_bezier_pieces(const G2BezierInput<S>& input, std::span<const S> tangents,
                        std::span<BezierPiece<S>> pieces) noexcept;

} // namespace splinefeed
