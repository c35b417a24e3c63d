// SPDX-License-Identifier: MIT
//
// How far a path is from programmed moves and they from it, and how its pieces meet: by sampling and by search, without
// a line of what blends them.
#pragma once

#include "programmed_moves.hpp"

namespace splinefeed_test {

/// A point of a segment in mm, and its first two derivatives.
template <Scalar S>
void point_of(const CurveSegment<S>& segment, Real u, PlaceMm& place, PlaceMm& first, PlaceMm& second) {
    const auto n = static_cast<unsigned>(segment.degree);
    for (const unsigned k : splinefeed::indices(segment.axes)) {
        std::array<Real, 10> row{};
        for (unsigned i = 0; i <= n; ++i) {
            row[i] = std::ldexp(exact(segment.control[k][i]), segment.unit_log2);
        }
        second[k] = 0.0L;
        for (unsigned left = n; left > 0; --left) {
            if (left == 2) {
                second[k] = static_cast<Real>(n * (n - 1)) * (row[2] - 2.0L * row[1] + row[0]);
            }
            if (left == 1) {
                first[k] = static_cast<Real>(n) * (row[1] - row[0]);
            }
            for (unsigned i = 0; i < left; ++i) {
                row[i] += u * (row[i + 1] - row[i]);
            }
        }
        place[k] = std::ldexp(static_cast<Real>(segment.origin[k].raw), -Position::fraction_bits) + row[0];
    }
}

template <Scalar S>
PlaceMm place_of(const CurveSegment<S>& segment, Real u) {
    PlaceMm place{};
    PlaceMm first{};
    PlaceMm second{};
    point_of(segment, u, place, first, second);
    return place;
}

/// A segment and places on it.
template <Scalar S>
struct SampledSegment {
    static constexpr int count = 16;
    const CurveSegment<S>* segment;
    std::array<PlaceMm, count + 1> places;

    explicit SampledSegment(const CurveSegment<S>& of) : segment(&of) {
        for (unsigned i = 0; i <= count; ++i) {
            places[i] = place_of(of, static_cast<Real>(i) / static_cast<Real>(count));
        }
    }
    /// Distance of a place: from the nearest one by steps of Newton.
    [[nodiscard]] Real distance(const PlaceMm& place) const {
        const int axes = segment->axes;
        Real u = 0.0L;
        Real least = 1e9L;
        for (unsigned i = 0; i <= count; ++i) {
            const Real d = apart(places[i], place, axes);
            u = d < least ? static_cast<Real>(i) / static_cast<Real>(count) : u;
            least = std::min(least, d);
        }
        for (int step = 0; step < 5; ++step) {
            PlaceMm here{};
            PlaceMm first{};
            PlaceMm second{};
            point_of(*segment, u, here, first, second);
            least = std::min(least, apart(here, place, axes));
            Real dot = 0.0L;
            Real square = 1e-30L;
            for (const unsigned k : splinefeed::indices(axes)) {
                dot += (place[k] - here[k]) * first[k];
                square += first[k] * first[k];
            }
            u = std::clamp(u + dot / square, 0.0L, 1.0L);
        }
        return least;
    }
};

/// The largest distance both ways, over the tolerance.
struct Deviation {
    Real most = 0.0L;
    std::size_t move = 0;   ///< near this move
    bool from_path = false; ///< from a place of the path to the moves
    Real at = 0.0L;         ///< t of the move, or u of the segment
};

template <Scalar S>
Deviation deviation(const MoveProgram& program, const std::vector<CurveSegment<S>>& segments, int samples = 16) {
    const int axes = program.axes;
    Deviation out;
    const auto count = static_cast<std::int64_t>(program.moves.size());
    for (const CurveSegment<S>& segment : segments) {
        for (int i = 0; i <= samples; ++i) {
            const PlaceMm place = place_of(segment, static_cast<Real>(i) / static_cast<Real>(samples));
            Real least = 1e9L;
            const auto here = static_cast<std::int64_t>(segment.waypoint);
            for (std::int64_t away = 0; away < count && least > out.most; ++away) { // the nearest moves first
                for (const std::int64_t n : {here - away, here + away}) {
                    if (n >= 0 && n < count) {
                        const ProgrammedMove& move = program.moves[static_cast<std::size_t>(n)];
                        const Real tolerance =
                            static_cast<Real>(std::max(move.tolerance_mm, program.joint_tolerance_mm));
                        least = std::min(least, move.distance(place, axes) / tolerance);
                    }
                }
            }
            if (least > out.most) {
                out = {least, segment.waypoint, true, static_cast<Real>(i) / static_cast<Real>(samples)};
            }
        }
    }
    const std::vector<SampledSegment<S>> sampled(segments.begin(), segments.end());
    for (std::size_t n = 0; n < program.moves.size(); ++n) {
        const ProgrammedMove& move = program.moves[n];
        const Real tolerance = static_cast<Real>(std::max(move.tolerance_mm, program.joint_tolerance_mm));
        // The segments of this move, and three on either side: the segment of a place counts to the move at its end.
        const auto index = static_cast<std::uint32_t>(n);
        const auto before = [](const CurveSegment<S>& segment, std::uint32_t i) {
            return segment.waypoint < i;
        };
        const auto low = std::lower_bound(segments.begin(), segments.end(), index, before) - segments.begin();
        const auto high = std::lower_bound(segments.begin(), segments.end(), index + 1, before) - segments.begin();
        const auto first = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, low - 3));
        const std::size_t last = std::min(segments.size(), static_cast<std::size_t>(high) + 4);
        for (int i = 0; i <= samples / 2; ++i) {
            const PlaceMm place = move.at(2.0L * static_cast<Real>(i) / static_cast<Real>(samples), axes);
            Real least = 1e9L;
            for (std::size_t m = first; m < last && least > out.most * tolerance; ++m) {
                least = std::min(least, sampled[m].distance(place));
            }
            if (least > out.most * tolerance) {
                out = {least / tolerance, n, false, 2.0L * static_cast<Real>(i) / static_cast<Real>(samples)};
            }
        }
    }
    return out;
}

/// What the joints of segments are: jumps of place, direction and curvature.
struct JointJumps {
    Real gap_mm = 0.0L;
    Real turn = 0.0L;      ///< largest, where the path goes on
    Real curvature = 0.0L; ///< largest jump there over the curvature and over what rounding makes of it
    int corners = 0;       ///< places where the direction jumps
    int curvature_corners = 0;
};

/// @param turn  a larger change of direction is a corner
template <Scalar S>
JointJumps jumps(const std::vector<CurveSegment<S>>& segments, Real turn = 1e-4L) {
    JointJumps out;
    for (std::size_t i = 0; i + 1 < segments.size(); ++i) {
        const int axes = segments[i].axes;
        std::array<PlaceMm, 2> place{};
        std::array<PlaceMm, 2> first{};
        std::array<PlaceMm, 2> second{};
        point_of(segments[i], 1.0L, place[0], first[0], second[0]);
        point_of(segments[i + 1], 0.0L, place[1], first[1], second[1]);
        out.gap_mm = std::max(out.gap_mm, apart(place[0], place[1], axes));
        std::array<Real, 2> speed{};
        std::array<Real, 2> bend{};
        for (unsigned n = 0; n < 2; ++n) {
            speed[n] = apart(first[n], {}, axes);
            Real along = 0.0L;
            for (const unsigned k : splinefeed::indices(axes)) {
                first[n][k] /= speed[n];
                along += first[n][k] * second[n][k];
            }
            for (const unsigned k : splinefeed::indices(axes)) {
                second[n][k] = (second[n][k] - along * first[n][k]) / (speed[n] * speed[n]);
            }
            bend[n] = apart(second[n], {}, axes);
        }
        const Real turned = apart(first[0], first[1], axes);
        if (turned > turn) {
            ++out.corners;
            continue;
        }
        out.turn = std::max(out.turn, turned);
        const Real shorter = std::min(speed[0], speed[1]);
        // Ends are rounded to 2^-40 mm, control points to 47 bits of the segment's size.
        const Real noise = 1e-6L * (bend[0] + bend[1]) + 1e-10L / (shorter * shorter) + 1e-9L / shorter;
        const Real jump = apart(second[0], second[1], axes) / noise;
        if (jump > 1.0L) {
            ++out.curvature_corners;
        }
        out.curvature = std::max(out.curvature, jump);
    }
    return out;
}

} // namespace splinefeed_test
