// SPDX-License-Identifier: MIT
// curve_hull: per-axis bounds of a curve, from its control points alone: nothing is sampled.
//
// A B-spline piece of degree k lies in the convex hull of its k + 1 vertices, and in the hull of its own Bezier points.
// These are convex combinations of those vertices, so the second bound is never wider (handbook 4.1). Here the hulls
// are boxes. Halving a Bezier piece makes its box as narrow as needed.
#pragma once

#include "splinefeed/splines/bezier_piece.hpp"

namespace splinefeed {

/// The interval from low to high.
template <Scalar S>
struct Extent {
    S low{};
    S high{};

    /// Whether `inner` lies inside, ends included.
    [[nodiscard]] constexpr bool contains(const Extent& inner) const noexcept {
        return low <= inner.low && inner.high <= high;
    }
};

/// Box of the points. The box of degree + 1 successive vertices of a B-spline contains their piece. Cost: two
/// comparisons per coordinate. @pre not empty
template <Scalar S>
[[nodiscard]] PerAxis<Extent<S>> vertex_hull(std::span<const Point<S>> vertices) noexcept;

/// Box of the piece's Bezier points. Cost: as above.
template <Scalar S>
[[nodiscard]] PerAxis<Extent<S>> bezier_hull(const BezierPiece<S>& piece) noexcept;

/// Extent of the Bezier points 0 to degree of one axis.
template <Scalar S>
[[nodiscard]] Extent<S> bezier_extent(const PerDegree<S>& points, int degree) noexcept;

/// The extent of one axis of a Bezier curve, as far as it exceeds `allowed`. The result lies inside the curve's extent.
/// On a side where the curve exceeds `allowed`, the result exceeds it too, and its end is the curve's own to within
/// `slack` (and 4^-24 of the piece). Cost: one look at each Bezier point if all are allowed; otherwise pieces are
/// halved until they are decided.
template <Scalar S>
[[nodiscard]] Extent<S> extent_beyond(const PerDegree<S>& points, int degree, const Extent<S>& allowed,
                                      S slack) noexcept;

} // namespace splinefeed
