// SPDX-License-Identifier: MIT
// boehm: a uniform B-spline curve of degree 2 or 3 as a chain of Bezier pieces; the points are control points.
//
// Source: the handbook's chapter 4.1, "Krzywe B-sklejane 3 i 2 stopnia". The sides of the control polygon are divided.
// The division points are the inner Bezier points, and the midpoints between them are the joints (Boehm's
// construction). Not followed: its rule taken literally for four vertices. It halves the middle side; but the curve is
// one Bezier piece and that side is not divided.
//
// Class: exactly C2 in the knot parameter for degree 3, and C1 for degree 2. If r' = 0 (three coincident vertices, or
// d_{i+1} = d_{i-1}) a cubic joint is a cusp. It is still C2, but its curvature is undefined. A joint of quadratics is
// G2 only if the triangles at its two vertices have the same area.
#pragma once

#include "splinefeed/splines/bezier_piece.hpp"

#include <cstdint>

namespace splinefeed {

/// The number types of Boehm's rule: a scalar, or whole numbers. If the vertices are multiples of 12 (open cubic), of 6
/// (closed cubic) or of 2 (quadratic), every Bezier point is a whole number, and integers compute it exactly.
template <class N>
concept BoehmNumber = Scalar<N> || std::same_as<N, std::int64_t>;

/// Bezier points 0 to degree of one piece.
template <BoehmNumber N>
using BoehmPoints = std::array<PerAxis<N>, 4>;

/// The number of parts into which a side of the polygon is divided around a cubic piece: the number of knot intervals
/// along that side. The piece runs along `along`. 0 in before or after: the curve is clamped at that end of the piece.
struct SideParts {
    int before = 3;
    int along = 3;
    int after = 3;
    int skipped = 1; ///< parts of `along` before the piece: 0 for the first piece of an open curve, otherwise 1

    /// For piece `piece` (from 0) of an open, clamped curve with `pieces` pieces.
    [[nodiscard]] static constexpr SideParts of_open(std::int64_t piece, std::int64_t pieces) noexcept {
        const auto least = [](std::int64_t a, std::int64_t b) {
            return a < b ? a : b;
        };
        // Side s of the polygon (from vertex s, pieces + 2 sides) covers min(s + 1, pieces + 2 - s) knot intervals, but
        // at most 3, and at most the number that exists.
        const auto parts = [&](std::int64_t side) {
            return static_cast<int>(least(least(3, pieces), least(side + 1, pieces + 2 - side)));
        };
        SideParts out;
        out.before = piece == 0 ? 0 : parts(piece);
        out.along = parts(piece + 1);
        out.after = piece + 1 == pieces ? 0 : parts(piece + 2);
        out.skipped = piece == 0 ? 0 : 1;
        return out;
    }
};

/// One cubic piece from the three sides around it. The points are offsets from the vertex where the side `along`
/// starts. Handbook 4.1, cubic rule. Cost: 3 divisions per axis by 1, 2 or 3. It uses convex combinations of the four
/// vertices: no overflow if |side| < 2^29 (Fixed).
template <BoehmNumber N>
void boehm_cubic(const PerAxis<N>& before, const PerAxis<N>& along, const PerAxis<N>& after, const SideParts& parts,
                 BoehmPoints<N>& out) noexcept;

/// One quadratic piece: the corner between two sides, as offsets from its vertex. Handbook 4.1, quadratic rule.
/// @param clamped_start,clamped_end  the piece starts (ends) at the vertex before (after), not at the middle of the
/// side
template <BoehmNumber N>
void boehm_quadratic(const PerAxis<N>& before, const PerAxis<N>& after, bool clamped_start, bool clamped_end,
                     BoehmPoints<N>& out) noexcept;

/// Number of pieces of a curve: open vertices - degree, closed vertices. 0 or less: too few vertices.
[[nodiscard]] constexpr std::int64_t boehm_pieces(std::int64_t vertices, int degree, bool closed) noexcept {
    return closed ? (vertices < 3 ? 0 : vertices) : vertices - degree;
}

/// The whole curve. Open: clamped, with uniform knots, at least degree + 1 vertices; it passes through the first and
/// the last. Closed: at least 3 vertices; the first is not repeated. If closed, piece i of degree 3 runs along side i
/// -> i+1, and piece i of degree 2 is the corner at vertex i. Coincident vertices are allowed. Handbook 4.1. Errors:
/// degree_out_of_range (not 2 or 3), too_few_points, storage_too_small (pieces.size() < boehm_pieces),
/// position_out_of_range (not finite), result_out_of_range (beyond 1/8 of the largest number). Cost: linear.
template <Scalar S>
Status boehm(std::span<const Point<S>> vertices, int degree, bool closed, std::span<BezierPiece<S>> pieces) noexcept;

/// The same in integers: exact if every coordinate is a multiple of boehm_scale; |coordinate| <= 2^60.
Status boehm(std::span<const PerAxis<std::int64_t>> vertices, int degree, bool closed,
             std::span<BoehmPoints<std::int64_t>> pieces) noexcept;

/// The factor for the vertices that makes all Bezier points whole numbers.
[[nodiscard]] constexpr std::int64_t boehm_scale(int degree, bool closed) noexcept {
    return degree == 2 ? 2 : closed ? 6 : 12;
}

} // namespace splinefeed
