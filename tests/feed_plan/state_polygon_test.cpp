// SPDX-License-Identifier: MIT
//
// Polygons of states against the half-planes that they were made with, at random states.
#include "splinefeed/s3_feed_plan/jerk_optimal/state_polygon.hpp"

#include "support/catch.hpp"

#include <cmath>
#include <random>
#include <vector>

using namespace splinefeed;

namespace {

constexpr std::uint32_t seed = 61;
constexpr double to_side = 1e-9; // so near either answer is right

struct Sets {
    std::mt19937 random{seed};
    double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
    StateBound bound(double reach) {
        const double angle = between(0.0, 6.2831853);
        return {std::cos(angle), std::sin(angle), between(-0.2, reach)};
    }
    SpeedState state() { return {between(-0.2, 2.2), between(-1.2, 1.2)}; }
};

// How far beyond the polygon a state is; negative: inside.
double excess(const StatePolygon& polygon, const SpeedState& state) {
    std::array<StateBound, StatePolygon::capacity + 4> sides;
    const std::size_t n = polygon.bounds(sides);
    double most = n > 0 ? -1e9 : 1e9;
    for (std::size_t i = 0; i < n; ++i) {
        const double size = std::hypot(sides[i].of_b, sides[i].of_slope);
        most = std::max(most, size > 0.0 ? sides[i].excess(state) / size : -1e9);
    }
    return most;
}

bool convex(const StatePolygon& polygon) {
    const auto c = polygon.corners();
    for (std::size_t i = 0; c.size() > 2 && i < c.size(); ++i) {
        const SpeedState& a = c[i];
        const SpeedState& b = c[(i + 1) % c.size()];
        const SpeedState& d = c[(i + 2) % c.size()];
        if ((b.b - a.b) * (d.slope - b.slope) - (b.slope - a.slope) * (d.b - b.b) < -to_side) {
            return false;
        }
    }
    return true;
}

} // namespace

TEST_CASE("what is left of a polygon is what all cuts allow", "[feed_plan][jerk]") {
    Sets sets;
    CAPTURE(seed);
    int inside = 0;
    for (int trial = 0; trial < 500; ++trial) {
        StatePolygon polygon(2.0, 1.0);
        std::vector<StateBound> bounds{{1, 0, 2}, {-1, 0, 0}, {0, 1, 1}, {0, -1, 1}};
        for (int i = 0; i < trial % 24; ++i) {
            bounds.push_back(sets.bound(2.0));
            polygon.cut(bounds.back());
        }
        REQUIRE(convex(polygon));
        for (int i = 0; i < 100; ++i) {
            const SpeedState state = sets.state();
            double most = -1e9;
            for (const StateBound& bound : bounds) {
                most = std::max(most, bound.excess(state));
            }
            if (polygon.empty()) {
                CHECK(most > -to_side);
            } else if (polygon.corners().size() > 2 && std::abs(most) > to_side) {
                REQUIRE((excess(polygon, state) <= to_side) == (most <= 0.0));
                inside += most <= 0.0;
            }
        }
    }
    CHECK(inside > 1000);
}

TEST_CASE("a cut says how many corners stay where they are", "[feed_plan][jerk]") {
    Sets sets;
    CAPTURE(seed);
    for (int trial = 0; trial < 1000; ++trial) {
        StatePolygon polygon(2.0, 1.0);
        polygon.cut(sets.bound(2.0));
        const StatePolygon before = polygon;
        const std::size_t same = polygon.cut(sets.bound(2.0));
        REQUIRE(same <= before.corners().size());
        for (std::size_t i = 0; i < same; ++i) {
            REQUIRE(polygon.corners()[i].b == before.corners()[i].b);
            REQUIRE(polygon.corners()[i].slope == before.corners()[i].slope);
        }
    }
}

TEST_CASE("a simplified polygon is a part of what it was, and a large one", "[feed_plan][jerk]") {
    Sets sets;
    CAPTURE(seed);
    for (int trial = 0; trial < 200; ++trial) {
        StatePolygon polygon(2.0, 1.0);
        for (int i = 0; i < 40; ++i) {
            const double angle = sets.between(0.0, 6.2831853);
            const double limit = std::cos(angle) + sets.between(0.9, 0.95);
            polygon.cut({std::cos(angle), std::sin(angle), limit});
        }
        const StatePolygon before = polygon;
        polygon.simplify();
        REQUIRE(polygon.corners().size() <= StatePolygon::kept);
        REQUIRE(convex(polygon));
        for (const SpeedState& corner : polygon.corners()) {
            REQUIRE(excess(before, corner) <= to_side);
        }
        for (const SpeedState& corner : before.corners()) {
            REQUIRE(excess(polygon, corner) < 0.12); // of a radius of 0.9
        }
    }
}

TEST_CASE("a state that is included, and all that was, is in the polygon", "[feed_plan][jerk]") {
    Sets sets;
    CAPTURE(seed);
    int outside = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        StatePolygon polygon(2.0, 1.0);
        for (int i = 0; i < trial % 8; ++i) {
            polygon.cut(sets.bound(2.0));
        }
        if (polygon.corners().size() < 3) {
            continue;
        }
        const StatePolygon before = polygon;
        const SpeedState state = sets.state();
        polygon.include(state);
        outside += excess(before, state) > 0.0;
        REQUIRE(convex(polygon));
        REQUIRE(excess(polygon, state) <= to_side);
        for (const SpeedState& corner : before.corners()) {
            REQUIRE(excess(polygon, corner) <= to_side);
        }
        for (const SpeedState& corner : polygon.corners()) {
            REQUIRE((excess(before, corner) <= to_side || (corner.b == state.b && corner.slope == state.slope)));
        }
    }
    CHECK(outside > 200);
}

TEST_CASE("points and lines have bounds, and are cut", "[feed_plan][jerk]") {
    StatePolygon line;
    line.append({0.0, 0.0});
    line.append({1.0, -1.0});
    CHECK(excess(line, {0.5, -0.5}) <= to_side);
    CHECK(excess(line, {0.5, -0.4}) > 0.01);
    CHECK(excess(line, {1.1, -1.1}) > 0.01);
    CHECK(excess(line, {-0.1, 0.1}) > 0.01);
    line.cut({1.0, 0.0, 0.25});
    REQUIRE(line.corners().size() == 2);
    CHECK(excess(line, {0.25, -0.25}) <= to_side);
    CHECK(excess(line, {0.3, -0.3}) > 0.01);
    line.cut({1.0, 0.0, -1.0});
    CHECK(line.empty());
    StatePolygon point;
    point.append({1.0, 2.0});
    CHECK(excess(point, {1.0, 2.0}) <= to_side);
    CHECK(excess(point, {1.1, 2.0}) > 0.01);
    CHECK(excess(point, {1.0, 1.9}) > 0.01);
}
