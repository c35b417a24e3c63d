// SPDX-License-Identifier: MIT
//
// BSplineCurve against the whole-curve method, bit by bit; runs, their degrees, and the seam of closed curves.
#include "splinefeed/s1_curve/bspline_curve.hpp"

#include "support/curve_harness.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

/// Coordinates that are whole multiples of 2^-20 mm: every scalar but float holds them and their differences exactly.
Path random_points(RandomPath& random, int axes, int count) {
    Path path{axes, {}};
    for (int i = 0; i < count; ++i) {
        PerAxis<Position> point{};
        for (const unsigned k : indices(axes)) {
            point[k].raw = static_cast<std::int64_t>(random.below(1 << 28) - (1 << 27)) << 20;
        }
        path.points.push_back(point);
    }
    return path;
}

CurveOptions<double> options(int axes) {
    return {axes, Parameterization::uniform, -2.0, 65536}; // no automatic corners
}

std::vector<BezierPiece<double>> batch(const Path& path, std::size_t from, std::size_t end, int degree, bool closed) {
    std::vector<Point<double>> vertices;
    for (std::size_t i = from; i < end; ++i) {
        Point<double> vertex{};
        for (const unsigned k : indices(path.axes)) {
            vertex[k] = to_mm(path.points[i][k]);
        }
        vertices.push_back(vertex);
    }
    std::vector<BezierPiece<double>> pieces(
        static_cast<std::size_t>(boehm_pieces(static_cast<std::int64_t>(vertices.size()), degree, closed)));
    REQUIRE(boehm<double>(vertices, degree, closed, pieces).ok());
    return pieces;
}

void same_bits(const CurveSegment<double>& segment, const BezierPiece<double>& piece, int axes) {
    REQUIRE(segment.degree == piece.degree);
    for (int k = 0; k < axes; ++k) {
        for (int i = 0; i <= piece.degree; ++i) {
            REQUIRE(segment.control_mm(k, i) == piece.control[static_cast<unsigned>(k)][static_cast<unsigned>(i)]);
        }
    }
}

template <Scalar S>
Vec end_of(const CurveSegment<S>& segment) {
    return origin_from(segment, {}) + bezier(segment, segment.degree);
}

} // namespace

TEST_CASE("bspline curve: streaming is the whole-curve method, bit by bit", "[curve][bspline]") {
    RandomPath random(path_seed + 50);
    CAPTURE(path_seed);
    for (int round = 0; round < 200; ++round) {
        const int degree = 2 + round % 2;
        const int axes = 1 + random.below(6);
        const int count = degree + 1 + random.below(round % 5 == 0 ? 100 : 8);
        CAPTURE(round, degree, axes, count);
        const Path path = random_points(random, axes, count);
        BSplineCurve<double> curve(options(axes), degree);
        const auto segments = run_curve<double>(curve, feeds_of<double>(path));
        const auto pieces = batch(path, 0, path.points.size(), degree, false);
        REQUIRE(segments.size() == pieces.size());
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            same_bits(segments[i], pieces[i], axes);
            const bool last = i + 1 == pieces.size();
            REQUIRE(segments[i].stop_at_end == last);
            REQUIRE(segments[i].waypoint == (last ? static_cast<unsigned>(count) - 1 : i + (degree == 3 ? 2 : 1)));
        }
        BSplineCurve<double> lazy(options(axes), degree);
        REQUIRE(same_curve(segments, run_curve<double>(lazy, feeds_of<double>(path), Pace::lazy)));
    }
}

TEST_CASE("bspline curve: a closed curve through lead-in and lead-out, bit by bit", "[curve][bspline]") {
    RandomPath random(path_seed + 51);
    CAPTURE(path_seed);
    for (int round = 0; round < 100; ++round) {
        const int degree = 2 + round % 2;
        const int axes = 1 + random.below(6);
        const Path path = random_points(random, axes, 3 + random.below(30));
        CAPTURE(round, degree, axes);
        BSplineCurve<double> curve(options(axes), degree);
        const auto segments = run_curve<double>(curve, closed_feeds(waypoints_of<double>(path)));
        const auto pieces = batch(path, 0, path.points.size(), degree, true);
        REQUIRE(segments.size() == pieces.size());
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            same_bits(segments[i], pieces[i], axes);
            REQUIRE_FALSE(segments[i].stop_at_end);
            for (int k = 0; k < axes; ++k) { // where the machine stands if this one is the last
                const double end = to_mm(segments[i].end[static_cast<unsigned>(k)]);
                REQUIRE(std::fabs(end - segments[i].control_mm(k, degree)) <= 0x1p-40);
            }
        }
    }
}

TEMPLATE_TEST_CASE("bspline curve: a corner ends the run, which is clamped there", "[curve][bspline]", double, float,
                   Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 52);
    CAPTURE(path_seed);
    for (int round = 0; round < 100; ++round) {
        const int degree = 2 + round % 2;
        const bool closed = round % 4 >= 2;
        const int count = 4 + random.below(20);
        const Path path = random.make(Shape::uneven, 3, count);
        auto points = waypoints_of<S>(path);
        std::vector<std::size_t> corners;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const bool corner = random.below(4) == 0;
            points[i].corner = corner ? Corner::forced : Corner::forbidden;
            if (corner || (!closed && (i == 0 || i + 1 == points.size()))) {
                corners.push_back(i);
            }
        }
        if (closed && corners.empty()) {
            continue;
        }
        CAPTURE(round, degree, closed, count);
        BSplineCurve<S> curve({3, Parameterization::chordal, literal<S>(0.5), 65536}, degree);
        const auto segments = run_curve<S>(curve, closed ? closed_feeds(points) : open_feeds(points));
        // Each run from corner to corner has the pieces of its own degree; the segments join; every corner is hit.
        std::size_t expected = 0;
        for (std::size_t c = 0; c + (closed ? 0 : 1) < corners.size(); ++c) {
            const bool around = c + 1 == corners.size();
            const std::size_t sides = (around ? corners[0] + points.size() : corners[c + 1]) - corners[c];
            expected += sides < static_cast<std::size_t>(degree) ? 1 : sides + 1 - static_cast<std::size_t>(degree);
        }
        REQUIRE(segments.size() == expected);
        std::size_t stops = 0;
        for (std::size_t i = 0; i < segments.size(); ++i) {
            const auto& segment = segments[i];
            const bool seam = i + 1 == segments.size();
            if (!seam || closed) {
                const auto& after = segments[(i + 1) % segments.size()];
                const Real gap = distance_of(end_of(segment), origin_from(after, {}) + bezier(after, 0));
                REQUIRE(gap <= 12.0L * rounding<S>(16.0L));
            }
            if (segment.stop_at_end) {
                ++stops;
                const Vec at = end_of(segment);
                const std::size_t waypoint =
                    closed ? (segment.waypoint + 16 * points.size() - 16) % points.size() : segment.waypoint;
                REQUIRE(std::find(corners.begin(), corners.end(), waypoint) != corners.end());
                for (unsigned k = 0; k < 3; ++k) {
                    REQUIRE(segment.end[k] == path.points[waypoint][k]);
                    const Real miss = at[k] - std::ldexp(static_cast<Real>(segment.end[k].raw), -40);
                    REQUIRE(std::fabs(miss) <= 4.0L * rounding<S>(16.0L));
                }
            }
        }
        REQUIRE(stops == corners.size() - (closed ? 0 : 1));
    }
}

TEST_CASE("bspline curve: runs that are too short for the degree", "[curve][bspline]") {
    for (const int degree : {2, 3}) {
        BSplineCurve<double> line(options(2), degree);
        const auto one = run_curve<double>(line, feeds_of<double>(path_of(2, {0, 0, 5, 1})));
        REQUIRE(one.size() == 1);
        CHECK(one[0].degree == 1);
        CHECK(one[0].control_mm(0, 1) == 5.0);
        BSplineCurve<double> arc(options(2), degree);
        const auto parabola = run_curve<double>(arc, feeds_of<double>(path_of(2, {0, 0, 5, 1, 6, 4})));
        REQUIRE(parabola.size() == 1);
        CHECK(parabola[0].degree == 2);
        CHECK(parabola[0].control_mm(1, 1) == 1.0);
        CHECK(parabola[0].control_mm(1, 2) == 4.0);
        CHECK(parabola[0].waypoint == 2);
    }
}
