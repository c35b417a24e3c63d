// SPDX-License-Identifier: MIT
#include "splinefeed/splines/catmull_rom_points.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/splines/point_list.hpp"

namespace splinefeed {

namespace {

template <Scalar S>
bool in_range(std::span<const Point<S>> points) noexcept {
    const S farthest = std::same_as<S, Fixed> ? literal<S>(0x1p25) : farthest_coordinate<S>();
    for (const Point<S>& point : points) {
        for (const S x : point) {
            if (!within(x, farthest)) {
                return false;
            }
        }
    }
    return true;
}

} // namespace

template <Scalar S>
void catmull_rom_tangent(const SpannedChord<S>& before, const SpannedChord<S>& after, S tension, int axes,
                         KnotTangent<S>& out) noexcept {
    out.by_span = false;
    const auto n = static_cast<unsigned>(axes);
    const S three = from_integer<S>(3);
    if (before.vector == nullptr || after.vector == nullptr) {
        const Point<S>& chord = before.vector == nullptr ? *after.vector : *before.vector;
        for (unsigned k = 0; k < n; ++k) {
            out.vector[k] = chord[k] / three * tension;
        }
    } else if (before.span == after.span) {
        for (unsigned k = 0; k < n; ++k) {
            out.vector[k] = ((*before.vector)[k] + (*after.vector)[k]) / three * tension;
        }
    } else {
        out.by_span = true;
        const S weight = before.span / (before.span + after.span); // of the later chord
        for (unsigned k = 0; k < n; ++k) {
            const S left = (*before.vector)[k] / before.span;
            const S right = (*after.vector)[k] / after.span;
            out.vector[k] = (left + weight * (right - left)) * (tension + tension);
        }
    }
}

template <Scalar S>
void catmull_rom_legs(const SpannedChord<S>& chord, const KnotTangent<S>& start, const KnotTangent<S>& end, int axes,
                      Point<S>& leg_in, Point<S>& leg_out) noexcept {
    const S reach = start.by_span || end.by_span ? chord.span / from_integer<S>(3) : S{};
    for (const unsigned k : indices(axes)) {
        leg_in[k] = start.by_span ? start.vector[k] * reach : start.vector[k];
        leg_out[k] = (*chord.vector)[k] - (end.by_span ? end.vector[k] * reach : end.vector[k]);
    }
}

template <Scalar S>
Status catmull_rom_points(std::span<const Point<S>> points, int axes, bool closed, S tension,
                          std::span<Point<S>> tangents, std::span<BezierPiece<S>> pieces) noexcept {
    const std::size_t count = points.size();
    if (count < (closed ? 3U : 2U)) {
        return Error::too_few_points;
    }
    if (!in_range(points)) {
        return Error::position_out_of_range;
    }
    if (!(tension >= S{} && tension <= from_integer<S>(10))) {
        return Error::tension_out_of_range;
    }
    if (tangents.size() < count || pieces.size() < pieces_through(count, closed)) {
        return Error::storage_too_small;
    }
    const auto n = static_cast<unsigned>(axes);
    for (std::size_t i = 0; i < count; ++i) {
        // The end points count twice.
        const std::size_t before = i > 0 ? i - 1 : closed ? count - 1 : 0;
        const std::size_t after = i + 1 < count ? i + 1 : closed ? 0 : i;
        for (unsigned k = 0; k < n; ++k) {
            tangents[i][k] = tension * (points[after][k] - points[before][k]);
        }
    }
    const S one = from_integer<S>(1);
    const auto chord_from = [&](std::size_t i) {
        return chord_between(points[i % count], points[(i + 1) % count]);
    };
    Point<S> chord = chord_from(count - 1); // not used for an open curve
    Point<S> next = chord_from(0);
    std::array<KnotTangent<S>, 2> ends{}; // of point i: [i % 2]
    catmull_rom_tangent<S>({closed ? &chord : nullptr, one}, {&next, one}, tension, axes, ends[0]);
    for (std::size_t i = 0; i < pieces_through(count, closed); ++i) {
        const std::size_t j = (i + 1) % count;
        const KnotTangent<S>& start = ends[i % 2];
        KnotTangent<S>& end = ends[(i + 1) % 2];
        chord = next;
        next = chord_from(j);
        const bool last = !closed && j + 1 == count;
        catmull_rom_tangent<S>({&chord, one}, {last ? nullptr : &next, one}, tension, axes, end);
        Point<S> leg_in{};
        Point<S> leg_out{};
        catmull_rom_legs<S>({&chord, one}, start, end, axes, leg_in, leg_out);
        BezierPiece<S>& piece = pieces[i];
        piece.degree = 3;
        for (unsigned k = 0; k < n; ++k) {
            piece.control[k][0] = points[i][k];
            piece.control[k][1] = points[i][k] + leg_in[k];
            piece.control[k][2] = points[i][k] + leg_out[k];
            piece.control[k][3] = points[j][k];
        }
    }
    return {};
}

#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template void catmull_rom_tangent<S>(const SpannedChord<S>&, const SpannedChord<S>&, S, int,                       \
                                         KnotTangent<S>&) noexcept;                                                    \
    template void catmull_rom_legs<S>(const SpannedChord<S>&, const KnotTangent<S>&, const KnotTangent<S>&, int,       \
                                      Point<S>&, Point<S>&) noexcept;                                                  \
    template Status catmull_rom_points<S>(std::span<const Point<S>>, int, bool, S, std::span<Point<S>>,                \
                                          std::span<BezierPiece<S>>) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
