// SPDX-License-Identifier: MIT
#include "splinefeed/splines/catmull_rom_modified.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"
#include "splinefeed/splines/point_list.hpp"

namespace splinefeed {

namespace {

// 2 u - central: a parabola's mean slope over a chord is the mean of its slopes at both ends.
template <Scalar S>
Point<S> mirrored(const Chord<S>& chord, const Point<S>& central) noexcept {
    Point<S> out{};
    for (unsigned k = 0; k < all_axes; ++k) {
        const S unit = chord.vector[k] / chord.length;
        out[k] = unit + (unit - central[k]);
    }
    return out;
}

template <Scalar S>
Chord<S> chord_of(const Point<S>& from, const Point<S>& to) noexcept {
    Chord<S> chord{chord_between(from, to), S{}};
    chord.length = norm(chord.vector, max_axes);
    return chord;
}

} // namespace

template <Scalar S>
Point<S> central_slope(const Chord<S>& before, const Chord<S>& after) noexcept {
    Point<S> out{};
    const S weight = before.length / (before.length + after.length); // the shorter chord's direction counts more
    for (unsigned k = 0; k < all_axes; ++k) {
        const S left = before.vector[k] / before.length;
        const S right = after.vector[k] / after.length;
        out[k] = left + weight * (right - left);
    }
    return out;
}

template <Scalar S>
Point<S> left_slope(const Chord<S>& first, const Chord<S>& second) noexcept {
    return mirrored(first, central_slope(first, second));
}

template <Scalar S>
Point<S> right_slope(const Chord<S>& first, const Chord<S>& second) noexcept {
    return mirrored(second, central_slope(first, second));
}

template <Scalar S>
Point<S> only_slope(const Chord<S>& chord) noexcept {
    Point<S> out{};
    for (unsigned k = 0; k < all_axes; ++k) {
        out[k] = chord.vector[k] / chord.length;
    }
    return out;
}

template <Scalar S>
void modified_legs(const Chord<S>& chord, const Point<S>& start_slope, const Point<S>& end_slope,
                   const ModifiedTangents<S>& tangents, Point<S>& leg_in, Point<S>& leg_out) noexcept {
    const S speed = tangents.mode == ChordFactor::chord ? tangents.factor * chord.length : tangents.factor;
    const S reach = speed / from_integer<S>(3);
    for (unsigned k = 0; k < all_axes; ++k) {
        leg_in[k] = start_slope[k] * reach;
        leg_out[k] = chord.vector[k] - end_slope[k] * reach;
    }
}

template <Scalar S>
Result<std::size_t> modified_catmull_rom(std::span<const Point<S>> points, bool closed,
                                         const ModifiedTangents<S>& tangents, const ModifiedCurve<S>& out) noexcept {
    if (first_bad_point(points) != points.size()) {
        return Error::position_out_of_range;
    }
    // The doubles of the point list's limits: a leg is at most factor * h, h at most sqrt(6) times a chord.
    const S most = tangents.mode == ChordFactor::chord ? literal<S>(2) : literal<S>(0x1p20);
    if (!(tangents.factor >= S{} && tangents.factor <= most)) {
        return Error::factor_out_of_range;
    }
    const std::size_t count = closed ? closed_count(points) : points.size();
    if (count < (closed ? 3U : 2U)) {
        return Error::too_few_points;
    }
    const std::size_t segments = closed ? count : count - 1;
    if (out.chords.size() < segments || out.derivatives.size() < count || out.pieces.size() < segments) {
        return Error::storage_too_small;
    }
    const auto chord_at = [&](std::size_t i) {
        return chord_of(points[i % count], points[(i + 1) % count]);
    };
    for (std::size_t i = 0; i < segments; ++i) {
        out.chords[i] = chord_at(i).length;
        if (!(out.chords[i] > S{})) {
            return Error::coincident_points;
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (closed || (i > 0 && i + 1 < count)) {
            // i - 1 modulo count: before point 0 of a closed curve is the last one, after the last is point 0
            out.derivatives[i] = central_slope(chord_at(i + count - 1), chord_at(i));
        } else if (count == 2) {
            out.derivatives[i] = only_slope(chord_at(0));
        } else if (i == 0) {
            out.derivatives[i] = left_slope(chord_at(0), chord_at(1));
        } else {
            out.derivatives[i] = right_slope(chord_at(i - 2), chord_at(i - 1));
        }
    }
    for (std::size_t i = 0; i < segments; ++i) {
        const Point<S>& from = points[i];
        Point<S> leg_in{};
        Point<S> leg_out{};
        modified_legs(chord_at(i), out.derivatives[i], out.derivatives[(i + 1) % count], tangents, leg_in, leg_out);
        BezierPiece<S>& piece = out.pieces[i];
        piece.degree = 3;
        piece.set_point(0, from);
        piece.set_point(3, points[(i + 1) % count]);
        for (unsigned k = 0; k < all_axes; ++k) {
            piece.control[k][1] = from[k] + leg_in[k];
            piece.control[k][2] = from[k] + leg_out[k];
        }
    }
    return segments;
}

#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template Point<S> central_slope<S>(const Chord<S>&, const Chord<S>&) noexcept;                                     \
    template Point<S> left_slope<S>(const Chord<S>&, const Chord<S>&) noexcept;                                        \
    template Point<S> right_slope<S>(const Chord<S>&, const Chord<S>&) noexcept;                                       \
    template Point<S> only_slope<S>(const Chord<S>&) noexcept;                                                         \
    template void modified_legs<S>(const Chord<S>&, const Point<S>&, const Point<S>&, const ModifiedTangents<S>&,      \
                                   Point<S>&, Point<S>&) noexcept;                                                     \
    template Result<std::size_t> modified_catmull_rom<S>(std::span<const Point<S>>, bool, const ModifiedTangents<S>&,  \
                                                         const ModifiedCurve<S>&) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
