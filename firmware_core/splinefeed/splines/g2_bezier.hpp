// SPDX-License-Identifier: MIT
// g2_bezier: interpolation by cubic Bezier pieces that meet with continuous curvature, with bias and tension at each
// joint.
#pragma once

#include "splinefeed/splines/bezier_piece.hpp"

namespace splinefeed {

/// The conditions at a point: r'(0) = beta1 q'(1), r''(0) = beta1^2 q''(1) + beta2 q'(1). Default: the ratio of the
/// chords and no tension; with that at every joint the curve is the C2 cubic spline by chord length.
template <Scalar S>
struct G2BezierJoint {
    bool chord_ratio = true;      ///< beta1 is |next chord| / |chord before|
    S beta1 = from_integer<S>(1); ///< bias if chord_ratio is false, greater than 0
    S beta2{};                    ///< tension, 0 or more: pulls the tangent towards zero and the curve towards its
                                  ///< chords
};

/// The input. Coordinates of points and tangents are stored without gaps, `axes` numbers each: in 3-D this takes half
/// the memory of Point, and memory limits the length of a curve.
template <Scalar S>
struct G2BezierInput {
    int axes = 3;
    bool closed = false;            ///< a piece leads from the last point to the first; at least 3 points
    std::span<const S> coordinates; ///< `axes` numbers per point, at least 2 points
    /// One per joint (open: points 1 to n - 2; closed: points 0 to n - 1), or one for all joints, or none: the default.
    std::span<const G2BezierJoint<S>> joints;
    std::span<const S>
        start;              ///< derivative of the first piece at its start, `axes` numbers; empty: natural, r''(0) = 0
    std::span<const S> end; ///< derivative of the last piece at its end

    [[nodiscard]] std::size_t point_count() const noexcept {
        return axes > 0 ? coordinates.size() / static_cast<std::size_t>(axes) : 0;
    }
};

/// Solves for the tangents. tangents[i] is the derivative, by its own parameter, at the end of the piece that leads
/// to point i. beta1 times tangents[i] is the derivative at the start of the next piece. tangents[0] of an open curve
/// is the derivative at its start. Class G2 of the curvature vector at every joint, C2 by chord length with the
/// defaults. The constraint is Barsky & DeRose's with beta1^2 at q'' (they print beta1). Regular for every beta1 > 0
/// and beta2 >= 0 if the curve is open, or closed with the chord ratio. A closed curve whose beta1 do not multiply to 1
/// may be singular (system_singular; for example beta1 = 2.618 at every joint of an even number). With beta1 outside
/// 0.382 to 2.618 at every joint and no tension, tangents grow from joint to joint. Errors: coincident points if a
/// chord ratio is needed, beta1 <= 0, beta2 < 0, NaN. result_out_of_range if a tangent is beyond the range of S, in
/// Fixed also if the lengths of neighbouring chords differ by a factor of 2^20.
/// @param tangents  as many numbers as coordinates
/// @param scratch   one number per point
/// Cost: one forward and one backward pass, closed one forward pass more; no memory except the scratch. Derivation, and
/// why no pivoting is needed: g2_bezier.cpp.
template <Scalar S>
Status g2_bezier_tangents(const G2BezierInput<S>& input, std::span<S> tangents, std::span<S> scratch) noexcept;

/// The pieces, open n - 1, closed n, from the result of g2_bezier_tangents for the same input.
template <Scalar S>
Status g2_bezier_pieces(const G2BezierInput<S>& input, std::span<const S> tangents,
                        std::span<BezierPiece<S>> pieces) noexcept;

} // namespace splinefeed
