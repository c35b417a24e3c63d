// SPDX-License-Identifier: MIT
//
// CatmullRomModified: the whole-curve method bit by bit, corners, the seam.
#include "splinefeed/s1_curve/catmull_rom_modified.hpp"

#include "support/curve_harness.hpp"
#include "support/spline_points.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

template <Scalar S>
std::vector<BezierPiece<S>> batch(const std::vector<Point<S>>& points, bool closed, ModifiedTangents<S> tangents) {
    std::vector<S> chords(points.size());
    std::vector<Point<S>> derivatives(points.size());
    std::vector<BezierPiece<S>> pieces(points.size());
    const auto count = modified_catmull_rom<S>(points, closed, tangents, {chords, derivatives, pieces});
    REQUIRE(count.has_value());
    pieces.resize(*count);
    return pieces;
}

} // namespace

TEST_CASE("catmull-rom modified: streaming is the whole-curve method bit by bit", "[curve][catmull_rom_modified]") {
    RandomPath random(path_seed + 50);
    CAPTURE(path_seed);
    for (int round = 0; round < 200; ++round) {
        const bool closed = round % 2 == 1;
        const int axes = 1 + random.below(6);
        const auto points = random_points<double>(random, axes, (closed ? 3 : 2) + random.below(40));
        const ModifiedTangents<double> tangents{round % 4 < 2 ? ChordFactor::chord : ChordFactor::constant,
                                                random.between(0.0, 2.0)};
        const auto pieces = batch(points, closed, tangents);
        CatmullRomModified<double> curve({axes, Parameterization::chordal, 0.5, 65536}, tangents.factor, tangents.mode);
        const auto waypoints = waypoints_at(points);
        const auto segments = run_curve<double>(curve, closed ? closed_feeds(waypoints) : open_feeds(waypoints),
                                                round % 3 == 0 ? Pace::lazy : Pace::eager);
        CAPTURE(round);
        require_same_cubics(segments, pieces, axes);
    }
}

TEMPLATE_TEST_CASE("catmull-rom modified: a corner ends the curve and starts another", "[curve][catmull_rom_modified]",
                   double, float, Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 51);
    for (int round = 0; round < 40; ++round) {
        const auto points = random_points<S>(random, 3, 5 + random.below(20));
        auto waypoints = waypoints_at(points);
        const auto corner = static_cast<std::size_t>(1 + random.below(static_cast<int>(points.size()) - 2));
        waypoints[corner].corner = Corner::forced;
        const CurveOptions<S> options{3, Parameterization::chordal, literal<S>(0.5), 65536};
        CatmullRomModified<S> whole(options, literal<S>(1));
        const auto segments = run_curve<S>(whole, open_feeds(waypoints));
        const auto middle = waypoints.begin() + static_cast<std::ptrdiff_t>(corner);
        CatmullRomModified<S> one(options, literal<S>(1));
        CatmullRomModified<S> two(options, literal<S>(1));
        auto parts = run_curve<S>(one, open_feeds<S>({waypoints.begin(), middle + 1}));
        const auto rest = run_curve<S>(two, open_feeds<S>({middle, waypoints.end()}));
        parts.insert(parts.end(), rest.begin(), rest.end());
        REQUIRE(segments.size() == parts.size());
        for (std::size_t i = 0; i < parts.size(); ++i) {
            REQUIRE(same_shape(segments[i], parts[i]));
        }
        REQUIRE(segments[corner - 1].stop_at_end);
    }
}
