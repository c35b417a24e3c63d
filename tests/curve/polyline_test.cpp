// SPDX-License-Identifier: MIT
//
// Polyline: lines from waypoint to waypoint, and what it passes on about corners.
#include "splinefeed/s1_curve/polyline.hpp"

#include "support/curve_harness.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

TEMPLATE_TEST_CASE("polyline: each segment is the exact chord", "[curve][polyline]", double, float, Fixed) {
    using S = TestType;
    RandomPath random;
    CAPTURE(path_seed);
    for (const Shape shape : all_shapes) {
        const Path path = random.make(shape, 1 + random.below(6), 100);
        Polyline<S> curve(CurveOptions<S>{path.axes});
        const auto segments = run_curve<S>(curve, feeds_of<S>(path));
        const std::vector<Vec> chords = chords_of(path);
        REQUIRE(segments.size() == chords.size());
        for (std::size_t i = 0; i < chords.size(); ++i) {
            REQUIRE(segments[i].degree == 1);
            REQUIRE(segments[i].origin == path.points[i]);
            REQUIRE(segments[i].end == path.points[i + 1]);
            REQUIRE(segments[i].waypoint == i + 1);
            REQUIRE_FALSE(segments[i].stop_at_end);
            REQUIRE(size(bezier(segments[i], 0)) == 0.0L);
            for (const unsigned k : indices(path.axes)) { // rounded once
                const Real error = std::fabs(bezier(segments[i], 1)[k] - chords[i][k]);
                REQUIRE(error <= rounding<S>(std::fabs(chords[i][k])));
            }
        }
    }
}

TEMPLATE_TEST_CASE("polyline: only forced corners are flagged, feeds belong to the move's end", "[curve][polyline]",
                   double, float, Fixed) {
    using S = TestType;
    Path path = path_of(2, {0, 0, 1, 0, 1, 1, 2, 1, 3, 1, 3, 0});
    auto feeds = feeds_of<S>(path);
    feeds[0].point.corner = Corner::forced;
    feeds[3].point.corner = Corner::forced; // on a straight line
    feeds[2].point.corner = Corner::forbidden;
    for (int i = 0; i < 6; ++i) {
        feeds[static_cast<unsigned>(i)].point.feed_mm_s = from_integer<S>(10 * i);
        feeds[static_cast<unsigned>(i)].point.max_feed_mm_s = from_integer<S>(15 * i);
    }
    Polyline<S> curve(CurveOptions<S>{2});
    const auto segments = run_curve<S>(curve, feeds);
    REQUIRE(segments.size() == 5);
    for (std::size_t i = 0; i < 5; ++i) {
        REQUIRE(segments[i].stop_at_end == (i == 2));
        REQUIRE(segments[i].feed_mm_s == from_integer<S>(10 * (static_cast<int>(i) + 1)));
        REQUIRE(segments[i].max_feed_mm_s == from_integer<S>(15 * (static_cast<int>(i) + 1)));
    }
}
