// SPDX-License-Identifier: MIT
//
// Closed g2 curves: the seam is a joint like any other, and the whole is the periodic spline.
#include "splinefeed/s1_curve/g2_spline.hpp"

#include "support/curve_harness.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

/// A random loop around the origin, radius 5 to 15 mm, with some height.
Path loop(RandomPath& random, int axes, int count) {
    std::vector<double> mm;
    for (int i = 0; i < count; ++i) {
        const double angle = 6.283185307179586 * (i + random.between(-0.3, 0.3)) / count;
        const double radius = random.between(5.0, 15.0);
        const double at[6] = {radius * std::cos(angle),  radius * std::sin(angle),  random.between(-3.0, 3.0),
                              random.between(-1.0, 1.0), random.between(-0.1, 0.1), random.between(-9.0, 9.0)};
        mm.insert(mm.end(), at, at + axes);
    }
    return path_of(axes, mm);
}

template <Scalar S>
std::vector<CurveSegment<S>> run_closed(const std::vector<Waypoint<S>>& points, int axes, Parameterization how,
                                        Pace pace = Pace::eager) {
    G2Spline<S> curve({axes, how, literal<S>(0.5)});
    return run_curve<S>(curve, closed_feeds(points), pace);
}

template <Scalar S>
std::vector<Waypoint<S>> smooth_waypoints(const Path& path) {
    std::vector<Waypoint<S>> points = waypoints_of<S>(path);
    for (auto& point : points) {
        point.corner = Corner::forbidden;
    }
    return points;
}

/// The joint of the last segment with the first is the one that was emitted first: the same bits.
template <Scalar S>
void require_closed(const std::vector<CurveSegment<S>>& segments) {
    const CurveSegment<S>& first = segments.front();
    const CurveSegment<S>& last = segments.back();
    REQUIRE(last.end == first.origin);
    REQUIRE_FALSE(last.stop_at_end);
    const Joint joint = joint_of(last, first);
    // joint_ is added to the chord in one segment and stands alone in the other: one rounding apart, and one of units
    const Real e = 2.0L * rounding<S>(2.0L * std::max(size(bezier(last, 3)), size(bezier(first, 3))));
    REQUIRE(joint.gap <= e);
    const Real leg = joint.least_leg;
    REQUIRE(joint.direction <= 24.0L * e / leg);
    const Real jump = 6.0L * (8.0L / 3.0L * e / (leg * leg) + 4.0L * joint.curvature * e / leg);
    REQUIRE(joint.curvature_jump <= 6.0L * jump);
    if (!std::same_as<S, float>) {
        REQUIRE(joint.curvature_jump <= 5e-9L * std::max(1e-3L, joint.curvature));
    }
}

constexpr Parameterization parameterizations[] = {Parameterization::uniform, Parameterization::chordal,
                                                  Parameterization::centripetal};

} // namespace

TEMPLATE_TEST_CASE("g2 closed: the periodic spline, with a seam like any joint", "[curve][g2][closed]", double, float,
                   Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 10);
    CAPTURE(path_seed);
    Real worst = 0.0L;
    for (const Parameterization how : parameterizations) {
        for (const int count : {3, 4, 5, 6, 7, 8, 9, 10, 14, 15, 16, 17, 18, 31, 32, 33, 60}) {
            const int axes = 2 + random.below(5);
            CAPTURE(static_cast<int>(how), count, axes);
            const Path path = loop(random, axes, count);
            const auto segments = run_closed(smooth_waypoints<S>(path), axes, how);
            REQUIRE(segments.size() == static_cast<std::size_t>(count));
            require_closed(segments);
            Path round = path;
            round.points.push_back(path.points.front());
            const std::vector<Vec> chords = chords_of(round);
            const auto cubics = solve_periodic(chords, spans_of(chords, how));
            for (std::size_t i = 0; i < cubics.size(); ++i) {
                REQUIRE(segments[i].origin == path.points[i]);
                for (int p = 0; p <= 3; ++p) {
                    worst = std::max(worst, distance_of(bezier(segments[i], p), cubics[i][static_cast<unsigned>(p)]));
                }
            }
            // 13 rows of look-ahead and 16 of lead-in, each worth 0.268 to 0.35, of about 10 mm: 1e-6 mm is asked.
            // Single precision: 32 (1 + ratio) roundings of 30 mm, the bound of the open curves.
            const Real bound = std::same_as<S, float> ? 32.0L * 11.0L * rounding<S>(30.0L) : 2e-6L;
            REQUIRE(worst <= bound);
        }
    }
    CAPTURE(static_cast<double>(worst));
}

TEMPLATE_TEST_CASE("g2 closed: an explicit repeat of the first point is merged", "[curve][g2][closed]", double, float,
                   Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 11);
    CAPTURE(path_seed);
    for (const int count : {3, 4, 7, 10, 20}) {
        const Path path = loop(random, 3, count);
        auto points = smooth_waypoints<S>(path);
        const auto plain = run_closed(points, 3, Parameterization::chordal);
        points.push_back(points.front());
        // As one who does not look for the repeat would push it: it is in the lead-in, the path and the lead-out.
        std::vector<Feed<S>> feeds;
        for (int i = -18; i <= count + 1 + 18; ++i) {
            const int n = count + 1;
            const auto wrapped = static_cast<unsigned>(((i % n) + n) % n);
            feeds.push_back({points[wrapped], i < 0 ? Role::lead_in : i <= n ? Role::path : Role::lead_out});
        }
        G2Spline<S> curve({3, Parameterization::chordal, literal<S>(0.5)});
        const auto repeated = run_curve<S>(curve, feeds);
        CAPTURE(count);
        REQUIRE(repeated.size() == plain.size());
        require_closed(repeated);
        for (std::size_t i = 0; i < plain.size(); ++i) {
            REQUIRE(plain[i].origin == repeated[i].origin);
            for (int p = 0; p <= 3; ++p) { // not the same number of points in the lead-in: truncation
                const Real error = distance_of(bezier(plain[i], p), bezier(repeated[i], p));
                CHECK(static_cast<double>(error) <= (std::same_as<S, float> ? 32.0 * 11.0 * 6e-8 * 30.0 : 2e-6));
            }
        }
    }
}

TEMPLATE_TEST_CASE("g2 closed: two corners, one just before or after the seam", "[curve][g2][closed]", double, float,
                   Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 13);
    CAPTURE(path_seed);
    const int count = 24;
    const Path path = loop(random, 2, count);
    for (const int near : {-2, -1, 1, 2}) {
        auto points = smooth_waypoints<S>(path);
        const int one = (near + count) % count;
        points[static_cast<unsigned>(one)].corner = Corner::forced;
        points[12].corner = Corner::forced;
        const auto segments = run_closed(points, 2, Parameterization::centripetal);
        require_closed(segments);
        for (const int corner : {one, 12}) {
            const int other = corner == 12 ? one : 12;
            const int length = (other - corner + count) % count;
            Path open{2, {}};
            for (int i = 0; i <= length; ++i) {
                open.points.push_back(path.points[static_cast<unsigned>((corner + i) % count)]);
            }
            const auto chords = chords_of(open);
            const auto cubics = solve_run(chords, spans_of(chords, Parameterization::centripetal));
            for (int i = 0; i < length; ++i) {
                for (int p = 0; p <= 3; ++p) {
                    const auto& segment = segments[static_cast<unsigned>((corner + i) % count)];
                    const Real error =
                        distance_of(bezier(segment, p), cubics[static_cast<unsigned>(i)][static_cast<unsigned>(p)]);
                    CAPTURE(near, corner, i, p);
                    CHECK(static_cast<double>(error) <= (std::same_as<S, float> ? 32.0 * 11.0 * 6e-8 * 30.0 : 2e-6));
                }
            }
        }
    }
}
