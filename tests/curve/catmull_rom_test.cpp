// SPDX-License-Identifier: MIT
//
// CatmullRom against its formula in long double, and against the method of all points.
#include "splinefeed/s1_curve/catmull_rom.hpp"

#include "splinefeed/splines/catmull_rom_points.hpp"
#include "support/curve_harness.hpp"
#include "support/spline_points.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

constexpr Parameterization parameterizations[] = {Parameterization::uniform, Parameterization::chordal,
                                                  Parameterization::centripetal};

/// The cubic between two waypoints; chords and spans before and after it only where the run goes on.
Cubic direct(const std::vector<Vec>& chords, const std::vector<Real>& h, std::size_t i, bool before, bool after,
             Real m) {
    // Derivative of the parabola through three points at the middle one, times 2 m.
    const auto middle = [&](std::size_t j) {
        const Vec in = (1.0L / h[j - 1]) * chords[j - 1];
        const Vec out = (1.0L / h[j]) * chords[j];
        return (2.0L * m / (h[j - 1] + h[j])) * (h[j] * in + h[j - 1] * out);
    };
    const Vec end = (m / h[i]) * chords[i]; // doubled end point
    const Vec start_slope = before ? middle(i) : end;
    const Vec end_slope = after ? middle(i + 1) : end;
    return {Vec{}, (h[i] / 3.0L) * start_slope, chords[i] - (h[i] / 3.0L) * end_slope, chords[i]};
}

/// Slopes chord / span are rounded where they are formed, and multiplied by a span: in Fixed u * span in chord units,
/// relative to the point itself in floating point. About a dozen roundings, of numbers up to 2 m + 1 times the chords;
/// the chord before or after counts by the ratio of its span.
template <Scalar S>
Real bound(const std::vector<Vec>& chords, const std::vector<Real>& h, std::size_t i, Real m, bool uniform) {
    Real longest = size(chords[i]);
    for (const std::size_t j : {i > 0 ? i - 1 : i, i + 1 < chords.size() ? i + 1 : i}) {
        longest = std::max(longest, size(chords[j]) * std::max(1.0L, uniform ? 1.0L : h[i] / (h[i] + h[j])));
    }
    // the largest span in chord units: 4096 if uniform, else the chord (its root is less, for chords above 1/4 um)
    const Real span = uniform ? 4096.0L : longest * 4096.0L;
    const Real fixed = std::same_as<S, Fixed> ? 0x1p-45L * 4.0L * (2.0L * m + 1.0L) * span : 0.0L;
    return 12.0L * (2.0L * m + 1.0L) * rounding<S>(longest) + fixed;
}

} // namespace

TEMPLATE_TEST_CASE("catmull-rom: the formula, three parameterizations", "[curve][catmull_rom]", double, float, Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 30);
    CAPTURE(path_seed);
    for (const Shape shape : all_shapes) {
        for (const Parameterization how : parameterizations) {
            for (const double m : {0.0, 0.25, 0.5, 1.0, 3.0}) {
                const int count = 2 + random.below(40);
                const Path path = random.make(shape, 1 + random.below(6), count);
                auto feeds = feeds_of<S>(path);
                std::vector<bool> breaks;
                for (auto& feed : feeds) {
                    breaks.push_back(breaks.empty() || static_cast<int>(breaks.size()) + 1 == count ||
                                     random.below(6) == 0);
                    feed.point.corner = breaks.back() ? Corner::forced : Corner::forbidden;
                }
                CatmullRom<S> curve({path.axes, how, literal<S>(0.5)}, from_double<S>(m));
                const auto segments = run_curve<S>(curve, feeds);
                const auto chords = chords_of(path);
                const auto h = spans_of(chords, how);
                REQUIRE(segments.size() == chords.size());
                for (std::size_t i = 0; i < chords.size(); ++i) {
                    const Cubic cubic = direct(chords, h, i, !breaks[i], !breaks[i + 1], static_cast<Real>(m));
                    CAPTURE(static_cast<int>(shape), static_cast<int>(how), m, count, i);
                    REQUIRE(segments[i].degree == 3);
                    REQUIRE(segments[i].stop_at_end == breaks[i + 1]);
                    const Real allowed = bound<S>(chords, h, i, static_cast<Real>(m), how == Parameterization::uniform);
                    for (int p = 0; p <= 3; ++p) {
                        const Real error = distance_of(bezier(segments[i], p), cubic[static_cast<unsigned>(p)]);
                        REQUIRE(error <= allowed);
                    }
                }
            }
        }
    }
}

TEST_CASE("catmull-rom: uniform streaming is the whole-curve method bit by bit", "[curve][catmull_rom]") {
    RandomPath random(path_seed + 31);
    CAPTURE(path_seed);
    for (int round = 0; round < 200; ++round) {
        const bool closed = round % 2 == 1;
        const int axes = 1 + random.below(6);
        const auto points = random_points<double>(random, axes, (closed ? 3 : 2) + random.below(40));
        const double tension = round % 4 < 2 ? 0.5 : random.between(0.0, 10.0);
        std::vector<Point<double>> tangents(points.size());
        std::vector<BezierPiece<double>> pieces(pieces_through(points.size(), closed));
        REQUIRE(catmull_rom_points<double>(points, axes, closed, tension, tangents, pieces).ok());
        CatmullRom<double> curve({axes, Parameterization::uniform, 0.5, 65536}, tension);
        const auto waypoints = waypoints_at(points);
        const auto segments = run_curve<double>(curve, closed ? closed_feeds(waypoints) : open_feeds(waypoints),
                                                round % 3 == 0 ? Pace::lazy : Pace::eager);
        CAPTURE(round);
        require_same_cubics(segments, pieces, axes);
    }
}

#ifdef SPLINEFEED_HAS_JSON

#endif
