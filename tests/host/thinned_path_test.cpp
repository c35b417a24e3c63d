// SPDX-License-Identifier: MIT
#include "host_sim/report/thinned_path.hpp"

#include "support/catch.hpp"

#include <cmath>

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

ThinnedPath::Point on_circle(double way, double radius) {
    return {.time_s = way,
            .length_mm = way,
            .position = {radius * std::cos(way / radius), radius * std::sin(way / radius)}};
}

/// Of the lines, at a length. @pre length lies among them
PerAxis<double> at(const ThinnedPath& path, double length) {
    std::size_t i = 1;
    while (path.points()[i].length_mm < length) {
        ++i;
    }
    const ThinnedPath::Point& a = path.points()[i - 1];
    const ThinnedPath::Point& b = path.points()[i];
    const double share = (length - a.length_mm) / (b.length_mm - a.length_mm);
    return {a.position[0] + share * (b.position[0] - a.position[0]),
            a.position[1] + share * (b.position[1] - a.position[1])};
}

} // namespace

TEST_CASE("of a straight line the ends remain") {
    ThinnedPath path(2, 1000);
    for (int i = 0; i <= 500; ++i) {
        path.add({.length_mm = 0.1 * i,
                  .position = {0.08 * i, 0.06 * i},
                  .way = 0.1F,
                  .wanted = 0.2F,
                  .acceleration = i == 77 ? 0.9F : 0.1F});
    }
    path.finish(0.0, 0);
    REQUIRE(path.points().size() == 2);
    CHECK(path.points()[1].position[0] == 0.08 * 500);
    CHECK(path.points()[1].acceleration == 0.9F); // the largest of what was joined
    CHECK(path.points()[1].way == Approx(50.0));  // the sums
    CHECK(path.points()[1].wanted == Approx(100.0));
}

TEST_CASE("all points lie within the tolerance, also after the path was thinned again and again") {
    ThinnedPath path(2, 300);
    constexpr double radius = 50.0;
    constexpr int points = 200'000; // fifteen times round
    for (int i = 0; i < points; ++i) {
        path.add(on_circle(0.025 * i, radius));
    }
    path.finish(0.0, 0);
    CHECK(path.points().size() <= 300);
    CHECK(path.points().size() > 100);
    double farthest = 0.0;
    for (int i = 1; i < points - 1; i += 7) {
        const auto exact = on_circle(0.025 * i, radius).position;
        const auto line = at(path, 0.025 * i);
        farthest = std::max({farthest, std::fabs(exact[0] - line[0]), std::fabs(exact[1] - line[1])});
    }
    CHECK(farthest <= path.tolerance());
    CHECK(farthest > 0.05 * path.tolerance());
    CHECK(path.points().back().length_mm == 0.025 * (points - 1));
}

TEST_CASE("points that are to be kept are, and edges as long as there is room") {
    ThinnedPath path(1, 100);
    for (int i = 0; i < 90; ++i) {
        path.add({.length_mm = 1.0 * i, .position = {1.0 * i}, .keep = i % 10 == 0, .edge = i % 5 == 0});
    }
    CHECK(path.points().size() == 18);
    for (int i = 90; i < 2000; ++i) {
        path.add({.length_mm = 1.0 * i, .position = {1.0 * i}, .keep = i % 100 == 0, .edge = i % 5 == 0});
    }
    path.finish(0.0, 0);
    CHECK_FALSE(path.left_out());
    int kept = 0;
    for (const ThinnedPath::Point& point : path.points()) {
        kept += point.keep ? 1 : 0;
    }
    CHECK(kept == 9 + 19);
}

TEST_CASE("where all points are to be kept and are too many, the path says that it left some out") {
    ThinnedPath path(1, 100);
    for (int i = 0; i < 1000; ++i) {
        path.add({.length_mm = 1.0 * i, .position = {i % 2 == 0 ? 0.0 : 1.0}, .keep = true});
    }
    path.finish(0.0, 0);
    CHECK(path.left_out());
    CHECK(path.points().size() <= 100);
}
