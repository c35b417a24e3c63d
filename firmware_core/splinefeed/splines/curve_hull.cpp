// SPDX-License-Identifier: MIT
#include "splinefeed/splines/curve_hull.hpp"

#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

namespace {

constexpr int deepest = 24; // halvings; the width of a hull is then 4^-24 of its segment

template <Scalar S>
void include(Extent<S>& extent, S value) noexcept {
    extent.low = smaller(extent.low, value);
    extent.high = larger(extent.high, value);
}

} // namespace

template <Scalar S>
PerAxis<Extent<S>> vertex_hull(std::span<const Point<S>> vertices) noexcept {
    SPLINEFEED_ASSERT(!vertices.empty());
    PerAxis<Extent<S>> box{};
    for (unsigned k = 0; k < box.size(); ++k) {
        box[k] = {vertices[0][k], vertices[0][k]};
        for (const Point<S>& vertex : vertices) {
            include(box[k], vertex[k]);
        }
    }
    return box;
}

template <Scalar S>
Extent<S> bezier_extent(const PerDegree<S>& points, int degree) noexcept {
    Extent<S> extent{points[0], points[0]};
    for (unsigned i = 1; i <= static_cast<unsigned>(degree); ++i) {
        include(extent, points[i]);
    }
    return extent;
}

template <Scalar S>
PerAxis<Extent<S>> bezier_hull(const BezierPiece<S>& piece) noexcept {
    PerAxis<Extent<S>> box{};
    for (unsigned k = 0; k < box.size(); ++k) {
        box[k] = bezier_extent(piece.control[k], piece.degree);
    }
    return box;
}

// Depth first; the right halves wait, at most one of each depth.
template <Scalar S>
Extent<S> extent_beyond(const PerDegree<S>& points, int degree, const Extent<S>& allowed, S slack) noexcept {
    const auto n = static_cast<unsigned>(degree);
    Extent<S> found{points[0], points[0]};
    std::array<PerDegree<S>, static_cast<unsigned>(deepest) + 1U> waiting{};
    std::array<int, static_cast<unsigned>(deepest) + 1U> depth{};
    unsigned count = 1;
    waiting[0] = points;
    while (count > 0) {
        --count;
        const int level = depth[count];
        PerDegree<S> left{};
        PerDegree<S> right = waiting[count];
        include(found, right[0]);
        include(found, right[n]);
        const Extent<S> most = bezier_extent(right, degree);
        // Nothing below adds to the known result.
        const bool known = most.high <= larger(allowed.high, found.high) + slack &&
                           most.low >= smaller(allowed.low, found.low) - slack;
        if (known || level == deepest) {
            continue;
        }
        left[0] = right[0];
        for (unsigned step = 1; step <= n; ++step) {
            for (unsigned i = 0; i + step <= n; ++i) {
                right[i] = scale2(right[i] + right[i + 1], -1);
            }
            left[step] = right[0];
        }
        waiting[count] = right;
        depth[count++] = level + 1;
        waiting[count] = left;
        depth[count++] = level + 1;
    }
    return found;
}

#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template PerAxis<Extent<S>> vertex_hull(std::span<const Point<S>>) noexcept;                                       \
    template PerAxis<Extent<S>> bezier_hull(const BezierPiece<S>&) noexcept;                                           \
    template Extent<S> bezier_extent(const PerDegree<S>&, int) noexcept;                                               \
    template Extent<S> extent_beyond(const PerDegree<S>&, int, const Extent<S>&, S) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
