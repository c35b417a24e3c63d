// SPDX-License-Identifier: MIT
//
// What all streaming curves share: merging, corners, errors, look-ahead, and that nothing depends on where the path is
// or how fast it is fed.
#include "splinefeed/s1_curve/waypoint_curve.hpp"

#include "splinefeed/s1_curve/catmull_rom.hpp"
#include "splinefeed/s1_curve/g2_spline.hpp"
#include "splinefeed/s1_curve/polyline.hpp"
#include "support/curve_harness.hpp"

#include <type_traits>

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

// No heap behind a curve: what it needs, however long the path, is inside it.
static_assert(std::is_trivially_destructible_v<G2Spline<double>> && std::is_trivially_destructible_v<G2Spline<Fixed>>);
static_assert(std::is_trivially_destructible_v<CatmullRom<Fixed>> && std::is_trivially_destructible_v<Polyline<Fixed>>);

template <Scalar S>
G2Spline<S> g2(int axes, Parameterization how = Parameterization::chordal) {
    return G2Spline<S>({axes, how, literal<S>(0.5)});
}

/// Calls `check` with a maker of each method.
template <Scalar S, class Check>
void for_each_method(int axes, const Check& check) {
    const CurveOptions<S> options{axes, Parameterization::chordal, literal<S>(0.5)};
    check([options] { return G2Spline<S>(options); });
    check([options] { return CatmullRom<S>(options, literal<S>(0.5)); });
    check([options] { return Polyline<S>(options); });
}

template <Scalar S>
Waypoint<S> at(std::int64_t x, std::int64_t y = 0) {
    Waypoint<S> point;
    point.position[0] = Position{x};
    point.position[1] = Position{y};
    return point;
}

/// Whether the g2 curve stops at each waypoint but the first.
template <Scalar S>
std::vector<bool> stops(const Path& path, double corner_degrees, const std::vector<Corner>& corners = {}) {
    auto feeds = feeds_of<S>(path);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        feeds[i].point.corner = corners[i];
    }
    G2Spline<S> curve({path.axes, Parameterization::chordal, from_double<S>(corner_cosine(corner_degrees))});
    std::vector<bool> out;
    for (const auto& segment : run_curve<S>(curve, feeds)) {
        out.push_back(segment.stop_at_end);
    }
    return out;
}

constexpr std::int64_t mm = std::int64_t{1} << 40;
constexpr double pi = 3.14159265358979323846;

} // namespace

TEST_CASE("curve: corner_cosine is the cosine", "[curve][corner]") {
    static_assert(corner_cosine(90.0) == 0.0);
    for (int degrees = 0; degrees <= 180; ++degrees) {
        REQUIRE(std::fabs(corner_cosine(degrees) - std::cos(degrees * pi / 180.0)) <= 4e-16);
    }
}

TEMPLATE_TEST_CASE("curve: corners by angle", "[curve][corner]", double, float, Fixed) {
    using S = TestType;
    // The slack of 1e-6 in the cosine is 0.66e-4 degrees at 60; a float cosine of three axes is wrong by about 5e-7.
    for (const double limit : {30.0, 60.0, 90.0, 120.0, 179.0}) {
        const double margin = limit > 170.0 ? 0.02 : 3e-4;
        for (const double scale : {0.001, 1.0, 160.0}) { // float takes moves up to 512 mm
            for (const double heading : {0.0, 17.0, 200.0}) {
                for (const int side : {-1, 1}) {
                    const double second = heading + limit + side * margin;
                    const Path path = path_of(
                        2, {0, 0, scale * std::cos(heading * pi / 180.0), scale * std::sin(heading * pi / 180.0),
                            scale * (std::cos(heading * pi / 180.0) + 3 * std::cos(second * pi / 180.0)),
                            scale * (std::sin(heading * pi / 180.0) + 3 * std::sin(second * pi / 180.0))});
                    CAPTURE(limit, scale, heading, side);
                    REQUIRE(stops<S>(path, limit) == std::vector<bool>{side > 0, true});
                }
            }
        }
    }
    // exactly 60 degrees, in integers: (1,1,0) . (1,0,1) = 1/2 of the product of their lengths
    REQUIRE(stops<S>(path_of(3, {0, 0, 0, 1, 1, 0, 2, 1, 1}), 60.0) == std::vector<bool>{false, true});
    REQUIRE(stops<S>(path_of(3, {0, 0, 0, 1, 1, 0, 8, 1, 7}), 60.0) == std::vector<bool>{false, true});
    // 180 degrees: nothing is a corner, not even the way back; 0: everything but straight on
    REQUIRE(stops<S>(path_of(1, {0, 1, 0.5}), 180.0) == std::vector<bool>{false, true});
    REQUIRE(stops<S>(path_of(2, {0, 0, 1, 1, 3, 3, 4, 4.1}), 0.0) == std::vector<bool>{false, true, true});
}

TEMPLATE_TEST_CASE("curve: forced and forbidden corners", "[curve][corner]", double, float, Fixed) {
    using S = TestType;
    const Path path = path_of(2, {0, 0, 1, 0, 1, 1, 2, 1, 3, 1, 4, 1, 4, 0});
    const auto a = Corner::automatic;
    const auto f = Corner::forced;
    const auto n = Corner::forbidden;
    using Flags = std::vector<bool>;
    CHECK(stops<S>(path, 60) == Flags{true, true, false, false, true, true});
    CHECK(stops<S>(path, 60, {a, n, n, a, a, n, a}) == Flags{false, false, false, false, false, true});
    CHECK(stops<S>(path, 60, {f, n, a, f, f, n, n}) == Flags{false, true, true, true, false, true});
    CHECK(stops<S>(path, 60, {n, f, f, f, f, f, f}) == Flags{true, true, true, true, true, true});
}

TEMPLATE_TEST_CASE("curve: waypoints within 0.1 um are one", "[curve][merge]", double, float, Fixed) {
    using S = TestType;
    const std::int64_t merge = mm / 10000;
    for_each_method<S>(2, [&](auto make) {
        auto curve = make();
        std::vector<CurveSegment<S>> out;
        REQUIRE(curve.push(at<S>(0)).ok());
        REQUIRE(curve.push(at<S>(merge - 1, 1 - merge)).ok()); // merged: index 1
        REQUIRE(curve.push(at<S>(merge)).ok());                // not: measured from the first, index 2
        REQUIRE(curve.push(at<S>(merge + merge - 1)).ok());    // merged: 3
        Waypoint<S> corner = at<S>(merge + 1, merge - 1);
        corner.corner = Corner::forced;
        REQUIRE(curve.push(corner).ok());                      // merged, but the corner counts: 4
        REQUIRE(curve.push(at<S>(merge + 1, 1 - merge)).ok()); // merged, and automatic takes nothing back: 5
        REQUIRE(curve.push(at<S>(mm)).ok());                   // 6
        REQUIRE(curve.push(at<S>(mm, -merge)).ok());           // the second axis alone suffices: 7
        REQUIRE(curve.finish().ok());
        drain<S>(curve, out);
        REQUIRE(out.size() == 3);
        REQUIRE(out[0].origin[0].raw == 0);
        REQUIRE(out[0].end[0].raw == merge);
        REQUIRE(out[0].waypoint == 2);
        REQUIRE(out[0].stop_at_end);
        REQUIRE(out[1].end[0].raw == mm);
        REQUIRE(out[1].waypoint == 6);
        REQUIRE(out[2].end[1].raw == -merge);
        REQUIRE(out[2].waypoint == 7);
    });
    // A point that leads in and is met again by the path is travelled from; one met by the lead-out stays in the path.
    for_each_method<S>(2, [&](auto make) {
        auto curve = make();
        std::vector<CurveSegment<S>> out;
        const std::int64_t x[] = {-mm, 0, 0, mm, 2 * mm, 2 * mm, 3 * mm};
        const Role roles[] = {Role::lead_in, Role::lead_in,  Role::path,    Role::path,
                              Role::path,    Role::lead_out, Role::lead_out};
        for (int i = 0; i < 7; ++i) {
            REQUIRE(curve.push(at<S>(x[i]), roles[i]).ok());
        }
        REQUIRE(curve.finish().ok());
        drain<S>(curve, out);
        REQUIRE(out.size() == 2);
        REQUIRE(out[0].origin[0].raw == 0);
        REQUIRE(out[1].end[0].raw == 2 * mm);
    });
}

TEMPLATE_TEST_CASE("curve: a move just above the merging distance does not throw the moves after it", "[curve][merge]",
                   double, float, Fixed) {
    using S = TestType;
    // On a line with chordal spans the spline is the line itself, at even speed. Whatever keeps the spans of neighbours
    // comparable may bend that, but no Bezier point has business further out than half a move.
    for (const Path& path : {path_of(1, {0, 0.0002, 100, 200, 300}), path_of(1, {0, 1, 1.0002, 500, 1000}),
                             path_of(1, {0, 100, 100.0002, 100.0004, 200, 300})}) {
        for_each_method<S>(1, [&](auto make) {
            auto curve = make();
            for (const auto& segment : run_curve<S>(curve, feeds_of<S>(path))) {
                const Real chord = bezier(segment, segment.degree)[0];
                for (int p = 0; p <= segment.degree; ++p) {
                    CAPTURE(segment.waypoint, p, static_cast<double>(chord));
                    const auto at_mm = static_cast<double>(bezier(segment, p)[0]);
                    CHECK(at_mm >= static_cast<double>(-0.5L * chord) - 1e-3);
                    CHECK(at_mm <= static_cast<double>(1.5L * chord) + 1e-3);
                }
            }
        });
    }
}

TEMPLATE_TEST_CASE("curve: refused waypoints leave no trace", "[curve][errors]", double, float, Fixed) {
    using S = TestType;
    for_each_method<S>(2, [&](auto make) {
        auto curve = make();
        const std::int64_t far = std::int64_t{1} << 60;                                     // 2^20 mm
        const std::int64_t longest = std::int64_t{1} << (std::same_as<S, float> ? 49 : 56); // 2^9 or 2^16 mm
        REQUIRE(curve.push(at<S>(far + 1)).error() == Error::position_out_of_range);
        REQUIRE(curve.push(at<S>(0, -far - 1)).error() == Error::position_out_of_range);
        REQUIRE(curve.push(at<S>(far, -far)).ok());
        REQUIRE(curve.push(at<S>(far, 1 - far + longest)).error() == Error::move_too_long);
        REQUIRE(curve.push(at<S>(far - longest - 1, -far)).error() == Error::move_too_long);
        REQUIRE(curve.push(at<S>(far + 1, -far)).error() == Error::position_out_of_range);
        REQUIRE(curve.push(at<S>(far - longest, -far)).ok());
        REQUIRE(curve.push(at<S>(far - longest - 1 - longest, -far)).error() == Error::move_too_long);
        REQUIRE(curve.push(at<S>(far - 2 * longest, longest - far)).ok());
        REQUIRE(curve.finish().ok());
        std::vector<CurveSegment<S>> out;
        drain<S>(curve, out);
        REQUIRE(out.size() == 2);
        REQUIRE(out[0].waypoint == 1);
        REQUIRE(out[1].waypoint == 2);
        REQUIRE(out[1].end[0].raw == far - 2 * longest);
    });
}

TEMPLATE_TEST_CASE("curve: nothing, one point, two points", "[curve][errors]", double, float, Fixed) {
    using S = TestType;
    for_each_method<S>(2, [&](auto make) {
        CurveSegment<S> segment;
        auto none = make();
        REQUIRE(none.has_room());
        REQUIRE(none.next(segment) == Pull::starved);
        REQUIRE(none.finish().error() == Error::too_few_waypoints);
        REQUIRE(none.next(segment) == Pull::finished);
        auto one = make();
        REQUIRE(one.push(at<S>(5)).ok());
        REQUIRE(one.next(segment) == Pull::starved);
        REQUIRE(one.push(at<S>(6)).ok()); // merged: still one
        REQUIRE(one.finish().error() == Error::too_few_waypoints);
        REQUIRE(one.next(segment) == Pull::finished);
        auto two = make();
        REQUIRE(two.push(at<S>(0, 0)).ok());
        REQUIRE(two.push(at<S>(3 * mm, -6 * mm)).ok());
        REQUIRE(two.next(segment) == Pull::starved);
        REQUIRE(two.finish().ok());
        REQUIRE(two.next(segment) == Pull::item);
        for (int p = 0; p <= segment.degree; ++p) { // the chord, evenly: tension 1/2 leaves at half speed
            const bool half = std::is_same_v<decltype(two), CatmullRom<S>> && p > 0 && p < 3;
            const Real f = half ? (p == 1 ? 1.0L / 6.0L : 5.0L / 6.0L) : static_cast<Real>(p) / segment.degree;
            REQUIRE(distance_of(bezier(segment, p), Vec{3.0L * f, -6.0L * f}) <= 8.0L * rounding<S>(7.0L) + 1e-11L);
        }
        REQUIRE(two.next(segment) == Pull::finished);
    });
}

TEMPLATE_TEST_CASE("curve: segments do not depend on when they are asked for", "[curve][streaming]", double, float,
                   Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 20);
    CAPTURE(path_seed);
    for (const Shape shape : {Shape::uneven, Shape::zigzag, Shape::short_moves}) {
        const Path path = random.make(shape, 3, 150);
        auto feeds = feeds_of<S>(path);
        for (auto& feed : feeds) {
            feed.point.feed_mm_s = from_integer<S>(1 + random.below(100));
            feed.point.corner = random.below(12) == 0 ? Corner::forced : Corner::automatic;
        }
        for_each_method<S>(3, [&](auto make) {
            auto eager = make();
            const auto expected = run_curve<S>(eager, feeds);
            auto lazy = make();
            REQUIRE(same_curve(expected, run_curve<S>(lazy, feeds, Pace::lazy)));
            for (int trial = 0; trial < 5; ++trial) {
                auto curve = make();
                std::vector<CurveSegment<S>> out;
                CurveSegment<S> segment;
                for (std::size_t pushed = 0; pushed < feeds.size();) {
                    if (curve.has_room() && random.below(3) != 0) {
                        REQUIRE(curve.push(feeds[pushed++].point).ok());
                    } else if (curve.next(segment) == Pull::item) {
                        out.push_back(segment);
                    } else {
                        REQUIRE(curve.has_room()); // starved and full would never go on
                    }
                }
                REQUIRE(curve.finish().ok());
                drain<S>(curve, out);
                REQUIRE(same_curve(expected, out));
            }
        });
    }
}

TEMPLATE_TEST_CASE("curve: look-ahead and room", "[curve][streaming]", double, float, Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 21);
    const Path path = random.make(Shape::even, 2, 100);
    const auto look_ahead = [&](auto curve) {
        CurveSegment<S> segment;
        std::uint32_t most = 0;
        std::uint32_t least = 100;
        for (std::uint32_t i = 0; i < 100; ++i) {
            REQUIRE(curve.push({path.points[i], S{}, Corner::forbidden}).ok());
            while (curve.next(segment) == Pull::item) {
                most = std::max(most, i - segment.waypoint);
                least = std::min(least, i - segment.waypoint);
            }
        }
        REQUIRE(most == least);
        return most;
    };
    CHECK(look_ahead(g2<S>(2)) == 16);
    CHECK(look_ahead(CatmullRom<S>(CurveOptions<S>{2}, literal<S>(0.5))) == 1);
    CHECK(look_ahead(Polyline<S>(CurveOptions<S>{2})) == 1);
    for_each_method<S>(2, [&](auto make) {
        auto curve = make();
        std::size_t pushed = 0;
        while (curve.has_room()) {
            REQUIRE(pushed < path.points.size());
            REQUIRE(curve.push({path.points[pushed++], S{}, Corner::automatic}).ok());
        }
        CHECK(pushed == 32); // the ring
        CurveSegment<S> segment;
        REQUIRE(curve.next(segment) == Pull::item);
    });
}

TEMPLATE_TEST_CASE("curve: a waypoint that finds no room is refused and nothing is lost", "[curve][streaming]", double,
                   float, Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 23);
    const auto feeds = open_feeds(waypoints_of<S>(random.make(Shape::uneven, 2, 100)));
    for_each_method<S>(2, [&](auto make) {
        auto eager = make();
        const auto expected = run_curve<S>(eager, feeds);
        auto curve = make();
        std::vector<CurveSegment<S>> out;
        CurveSegment<S> segment;
        int refused = 0;
        for (const auto& feed : feeds) {
            for (;;) {
                const Status pushed = curve.push(feed.point);
                if (pushed.ok()) {
                    break;
                }
                ++refused;
                REQUIRE(pushed.error() == Error::no_room);
                REQUIRE(curve.push(feed.point).error() == Error::no_room); // and again, as while a motion is held
                REQUIRE(curve.next(segment) == Pull::item);
                out.push_back(segment);
            }
        }
        CHECK(refused > 50);
        REQUIRE(curve.finish().ok());
        REQUIRE(curve.push(feeds[0].point).error() == Error::input_finished);
        drain<S>(curve, out);
        REQUIRE(same_curve(expected, out));
    });
}
