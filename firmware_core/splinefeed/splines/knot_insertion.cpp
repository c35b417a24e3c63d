// SPDX-License-Identifier: MIT
//
// A control point is the blossom f of the k knots inside its support, and a knot insertion computes f(.., t, ..) from
// f(.., a, ..) and f(.., b, ..) with a <= t <= b. For the Bezier points f(a^(k-j) b^j) of a span [a, b] the knots below
// a are replaced by a first, from the nearest outwards, and then those above b by b.
#include "splinefeed/splines/knot_insertion.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/splines/bspline_basis.hpp"

namespace splinefeed {

namespace {

/// from + (t - a) / (b - a) (to - from), for a <= t <= b.
template <Scalar S>
Point<S> between(const Point<S>& from, const Point<S>& to, S a, S b, S t, int axes) noexcept {
    const S weight = weight_ratio(t - a, b - a);
    Point<S> out{};
    for (const unsigned k : indices(axes)) {
        out[k] = from[k] + weighted(weight, to[k] - from[k]);
    }
    return out;
}

} // namespace

template <Scalar S>
Status insert_knot(GrowingCurve<S>& curve, S t) noexcept {
    const auto k = static_cast<std::size_t>(curve.degree);
    const std::size_t controls = curve.knot_count - k - 1U;
    if (curve.knots.size() <= curve.knot_count || curve.controls.size() <= controls) {
        return Error::storage_too_small;
    }
    const std::span<S> knots = curve.knots;
    if (!(t > knots[k]) || !(t < knots[controls])) {
        return Error::knots_invalid;
    }
    const std::size_t span = find_span<S>(knots.first(curve.knot_count), curve.degree, t);
    std::size_t multiplicity = 0;
    while (multiplicity <= span && knots[span - multiplicity] == t) {
        ++multiplicity;
    }
    if (multiplicity >= k) {
        return Error::knots_invalid;
    }
    for (std::size_t i = controls; i > span - multiplicity; --i) {
        curve.controls[i] = curve.controls[i - 1U];
    }
    for (std::size_t i = span - multiplicity; i > span - k; --i) {
        curve.controls[i] = between(curve.controls[i - 1U], curve.controls[i], knots[i], knots[i + k], t, curve.axes);
    }
    for (std::size_t i = curve.knot_count; i > span + 1U; --i) {
        knots[i] = knots[i - 1U];
    }
    knots[span + 1U] = t;
    ++curve.knot_count;
    return {};
}

template <Scalar S>
Status refine_knots(GrowingCurve<S>& curve, std::span<const S> finer) noexcept {
    if (curve.knots.size() < finer.size() ||
        curve.controls.size() + static_cast<std::size_t>(curve.degree) + 1U < finer.size()) {
        return Error::storage_too_small;
    }
    for (std::size_t i = 0; i < finer.size(); ++i) {
        if (i < curve.knot_count && curve.knots[i] == finer[i]) {
            continue;
        }
        // Knots below i agree; what comes next is either new here or missing in `finer`.
        if (i < curve.knot_count && !(finer[i] < curve.knots[i])) {
            return Error::knots_invalid;
        }
        if (const Status status = insert_knot(curve, finer[i]); !status.ok()) {
            return status;
        }
    }
    return curve.knot_count == finer.size() ? Status{} : Status{Error::knots_invalid};
}

template <Scalar S>
BezierPiece<S> bezier_piece(std::span<const S> knots, int degree, std::span<const Point<S>> controls, int axes,
                            std::size_t span) noexcept {
    const auto k = static_cast<std::size_t>(degree);
    const S a = knots[span];
    const S b = knots[span + 1U];
    PerDegree<Point<S>> c{};
    for (std::size_t r = 0; r <= k; ++r) {
        c[r] = controls[(span - k + r) % controls.size()];
    }
    // c[r] = f(a^s, knots[span-k+s+r+1] ... knots[span+r]): the s nearest of the knots below a have become a.
    for (std::size_t s = 1; s <= k; ++s) {
        for (std::size_t r = 0; r + s <= k; ++r) {
            c[r] = between(c[r], c[r + 1U], knots[span - k + s + r], knots[span + 1U + r], a, axes);
        }
    }
    // c[r] = f(a^(k-r), b, knots[span+2] ... knots[span+r]) now; the last of the knots above b becomes b, s times.
    for (std::size_t s = 1; s < k; ++s) {
        for (std::size_t r = k; r > s; --r) {
            c[r] = between(c[r - 1U], c[r], a, knots[span + 1U + r - s], b, axes);
        }
    }
    BezierPiece<S> piece;
    piece.degree = degree;
    for (std::size_t r = 0; r <= k; ++r) {
        piece.set_point(static_cast<int>(r), c[r]);
    }
    return piece;
}

template <Scalar S>
std::size_t bezier_piece_count(std::span<const S> knots, int degree) noexcept {
    const auto k = static_cast<std::size_t>(degree);
    std::size_t count = 0;
    for (std::size_t i = k; i + k + 1U < knots.size(); ++i) {
        count += knots[i] < knots[i + 1U] ? 1U : 0U;
    }
    return count;
}

template <Scalar S>
Status bezier_pieces(std::span<const S> knots, int degree, std::span<const Point<S>> controls, int axes, bool closed,
                     std::span<BezierPiece<S>> pieces, std::span<S> breaks) noexcept {
    const auto k = static_cast<std::size_t>(degree);
    const std::size_t count = bezier_piece_count(knots, degree);
    if (pieces.size() < count || breaks.size() < count + 1U) {
        return Error::storage_too_small;
    }
    std::size_t made = 0;
    for (std::size_t i = k; i + k + 1U < knots.size(); ++i) {
        if (!(knots[i] < knots[i + 1U])) {
            continue;
        }
        pieces[made] = bezier_piece(knots, degree, controls, axes, i);
        breaks[made] = knots[i];
        breaks[made + 1U] = knots[i + 1U];
        if (made > 0 && knots[i - k] < knots[i]) { // otherwise degree + 1 equal knots: the curve may jump here
            pieces[made].set_point(0, pieces[made - 1U].point(degree));
        }
        ++made;
    }
    if (closed && made > 0 && knots[0] < knots[k]) {
        pieces[made - 1U].set_point(degree, pieces[0].point(0));
    }
    return {};
}

#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template Status insert_knot(GrowingCurve<S>&, S) noexcept;                                                         \
    template Status refine_knots(GrowingCurve<S>&, std::span<const S>) noexcept;                                       \
    template BezierPiece<S> bezier_piece(std::span<const S>, int, std::span<const Point<S>>, int,                      \
                                         std::size_t) noexcept;                                                        \
    template std::size_t bezier_piece_count(std::span<const S>, int) noexcept;                                         \
    template Status bezier_pieces(std::span<const S>, int, std::span<const Point<S>>, int, bool,                       \
                                  std::span<BezierPiece<S>>, std::span<S>) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
