// SPDX-License-Identifier: MIT
// curve_hull: bounds on where a curve goes, per axis, from its control points alone: nothing is sampled.
//
// A B-spline piece of degree k lies in the convex hull of its k + 1 vertices, and in the hull of its own Bezier points,
// which are convex combinations of those vertices: the second bound is never wider (handbook 4.1). Here the hulls are
// boxes; halving a Bezier piece makes its box as narrow as is needed.
#pragma once

#include "splinefeed/splines/bezier_piece.hpp"

namespace splinefeed {

/// Values from low to high.
template <Scalar S>
struct Extent {
    S low{};
    S high{};

    /// Whether `inner` lies within, the ends included.
    [[nodiscard]] constexpr bool contains(const Extent& inner) const noexcept {
        return low <= inner.low && inner.high <= high;
    }
};

/// Box of the points; of degree + 1 successive vertices of a B-spline it holds their piece. Cost: two comparisons a
/// coordinate. @pre not empty
template <Scalar S>
[[nodiscard]] PerAxis<Extent<S>> vertex_hull(std::span<const Point<S>> vertices) noexcept;

/// Box of the piece's Bezier points. Cost: as above.
template <Scalar S>
[[nodiscard]] PerAxis<Extent<S>> bezier_hull(const BezierPiece<S>& piece) noexcept;

/// Extent of the Bezier points 0 to degree of one axis.
template <Scalar S>
[[nodiscard]] Extent<S> bezier_extent(const PerDegree<S>& points, int degree) noexcept;

/// How far one axis of a Bezier curve goes, as far as it matters: the result lies within the curve's extent, and where
/// that goes beyond `allowed`, so does the result, and its end on that side is the curve's own within `slack` (and
/// 4^-24 of the piece). A piece whose Bezier points are allowed costs one look at each; others are halved until they
/// are decided.
template <Scalar S>
[[nodiscard]] Extent<S> extent_beyond(const PerDegree<S>& points, int degree, const Extent<S>& allowed,
                                      S slack) noexcept;

} // namespace splinefeed
