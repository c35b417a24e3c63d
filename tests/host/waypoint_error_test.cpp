// SPDX-License-Identifier: MIT
#include "host_sim/analysis/waypoint_error.hpp"

#include "support/catch.hpp"

#include <cmath>
#include <vector>

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

using Point = std::array<double, 2>;

PerAxis<Position> at(double x, double y) {
    return {position_from_mm(x), position_from_mm(y)};
}

// A Bezier segment with these control points in mm that leads to a waypoint.
CurveSegment<double> bezier(const std::vector<Point>& points, std::uint32_t waypoint) {
    CurveSegment<double> segment;
    segment.axes = 2;
    segment.degree = static_cast<int>(points.size()) - 1;
    segment.origin = at(points[0][0], points[0][1]);
    segment.unit_log2 = -12;
    segment.waypoint = waypoint;
    for (unsigned k = 0; k < 2; ++k) {
        for (unsigned i = 0; i < points.size(); ++i) {
            segment.control[k][i] = std::ldexp(points[i][k] - to_mm(segment.origin[k]), 12);
        }
    }
    return segment;
}

CurveSegment<double> line(Point from, Point to, std::uint32_t waypoint) {
    return bezier({from, to}, waypoint);
}

/// Of waypoints 0, 1 and so on.
WaypointError error_of(const std::vector<Point>& waypoints) {
    WaypointError error;
    for (std::uint32_t i = 0; i < waypoints.size(); ++i) {
        error.waypoint(i, at(waypoints[i][0], waypoints[i][1]));
    }
    return error;
}

} // namespace

TEST_CASE("nothing has no error") {
    WaypointError error;
    CHECK(error.largest_mm() == 0.0);
    error.waypoint(0, at(1.0, 2.0));
    CHECK(error.largest_mm() == 0.0);
}

TEST_CASE("a curve through its waypoints has none either") {
    WaypointError error;
    for (std::uint32_t i = 0; i < 5; ++i) {
        error.waypoint(i, at(i * 0.5, 3.0));
    }
    for (std::uint32_t i = 1; i < 5; ++i) {
        const double x = i * 0.5;
        error.segment(bezier({{x - 0.5, 3.0}, {x - 0.4, 3.25}, {x - 0.1, 2.75}, {x, 3.0}}, i));
        CHECK(error.largest_mm() < 1e-12);
    }
}

TEST_CASE("the distance is that of the nearest point, not of the segment's end") {
    WaypointError error = error_of({{0.0, 0.0}, {10.0, 0.003}, {20.0, 0.0}}); // the second is beside the path
    SECTION("before the end") {
        error.segment(line({0.0, 0.0}, {10.7, 0.0}, 1));
        CHECK(error.largest_mm() == Approx(0.003));
        error.segment(line({10.7, 0.0}, {20.0, 0.0}, 2));
    }
    SECTION("after the end") {
        error.segment(line({0.0, 0.0}, {9.3, 0.0}, 1));
        CHECK(error.largest_mm() == Approx(0.7).epsilon(1e-4));
        error.segment(line({9.3, 0.0}, {20.0, 0.0}, 2));
    }
    CHECK(error.largest_mm() == Approx(0.003).epsilon(1e-9));
}

TEST_CASE("the first waypoint is measured at the start") {
    WaypointError error = error_of({{-0.004, 0.003}, {1.0, 0.0}});
    error.segment(line({0.0, 0.0}, {1.0, 0.0}, 1));
    CHECK(error.largest_mm() == Approx(0.005).epsilon(1e-9));
}

TEST_CASE("the nearest point of a curved segment is found to the nanometre") {
    // A parabola y = x^2 over [-1, 1]; from (0, h) with h > 1/2 the nearest points are at x^2 = h - 1/2.
    WaypointError error = error_of({{-1.0, 1.0}, {0.0, 1.0}});
    error.segment(bezier({{-1.0, 1.0}, {0.0, -1.0}, {1.0, 1.0}}, 1));
    CHECK(error.largest_mm() == Approx(std::sqrt(0.75)).epsilon(1e-12));
}

TEST_CASE("several segments may lead to one waypoint") {
    WaypointError error = error_of({{0.0, 0.0}, {2.0, 0.001}, {3.0, 0.0}});
    error.segment(line({0.0, 0.0}, {1.0, 0.0}, 1));
    error.segment(line({1.0, 0.0}, {2.0, 0.0}, 1));
    CHECK(error.largest_mm() == Approx(0.001));
    error.segment(line({2.0, 0.0}, {3.0, 0.0}, 2));
    CHECK(error.largest_mm() == Approx(0.001));
}

TEST_CASE("waypoints that no segment leads to are measured where they were merged") {
    WaypointError error = error_of({
        {0.0, 0.0},
        {1.0, 0.0},
        {1.0, 0.0},    // the same
        {1.0, 0.9e-6}, // within the nanometre
        {1.0, 0.002},  // merged by a coarser curve
        {2.0, 0.0},
    });
    error.segment(line({0.0, 0.0}, {1.0, 0.0}, 1));
    CHECK(error.largest_mm() == Approx(0.9e-6).epsilon(1e-4));
    error.segment(line({1.0, 0.0}, {2.0, 0.0}, 5));
    CHECK(error.largest_mm() == Approx(0.002));
}

TEST_CASE("waypoints that the curve has not reached do not count") {
    WaypointError error = error_of({{0.0, 0.0}, {1.0, 0.0}, {1.0, 500.0}});
    error.segment(line({0.0, 0.0}, {1.0, 0.0}, 1));
    CHECK(error.largest_mm() == 0.0);
}

TEST_CASE("far from the origin nothing is lost") {
    WaypointError error = error_of({{500000.0, -500000.0}, {500001.0, -500000.0 + 1e-7}});
    error.segment(line({500000.0, -500000.0}, {500001.0, -500000.0}, 1));
    CHECK(error.largest_mm() == Approx(1e-7).epsilon(1e-3));
}

TEST_CASE("waypoints are told apart where their index wraps") {
    WaypointError error;
    for (std::uint32_t i = 0; i < 6; ++i) {
        error.waypoint(i - 3, at(i, i == 2 ? 0.5 : i == 4 ? -0.25 : 0.0));
    }
    for (std::uint32_t i = 1; i < 6; ++i) {
        error.segment(line({i - 1.0, 0.0}, {static_cast<double>(i), 0.0}, i - 3));
    }
    CHECK(error.largest_mm() == Approx(0.5));
}
