// SPDX-License-Identifier: MIT
//
// Cells that begin or end at rest, against the jerk along them in long double.
#include "splinefeed/s3_feed_plan/jerk/jerk_cell.hpp"

#include "support/catch.hpp"
#include "support/jerk_reference.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

// b = c s^(4/3) from the end at rest: jerk of the axes at many points, of the limit.
long double jerk_from_rest(const JerkCell<double>& cell, unsigned moving, long double largest_b) {
    const long double l = wide(cell.length_mm);
    const long double along = 2 * largest_b * std::sqrt(largest_b) / (9 * l * l);
    long double most = 0;
    for (unsigned k = 0; k < 2; ++k) {
        const long double sign = moving == 1 ? 1 : -1;
        const AxisEnd<double>& rest = cell.end[1 - moving][k];
        const AxisEnd<double>& at = cell.end[moving][k];
        const long double d0 = wide(rest.second) * l;
        const long double d1 = wide(at.second) * l;
        const long double rise = sign * (wide(at.first) - wide(rest.first));
        const long double c2 = 3 * rise - 2 * d0 - d1;
        const long double c3 = d0 + d1 - 2 * rise;
        for (int i = 0; i <= 50; ++i) {
            const long double x = i / 50.0L;
            const long double first = sign * wide(rest.first) + x * (d0 + x * (c2 + x * c3));
            const long double second = (d0 + x * (2 * c2 + x * 3 * c3)) / l;
            const long double third = (2 * c2 + x * 6 * c3) / (l * l);
            const long double s = x * l;
            most = std::max(most, along * std::abs(first + 9 * second * s + 4.5L * third * s * s) /
                                      wide(cell.limits.jerk_mm_s3[k]));
        }
    }
    return most;
}

} // namespace

TEST_CASE("from rest and to rest the jerk is kept all along the cell, and used", "[feed_plan][jerk]") {
    std::mt19937 random{71};
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    CAPTURE("seed 71");
    long double least = 1;
    for (int trial = 0; trial < 2000; ++trial) {
        const JerkLimits limits{2000.0, 50000.0, 1e9};
        const Wave wave{{unit(random), unit(random)}, {2.0 * unit(random), 6.0 * unit(random)}};
        const JerkCell<double> cell = wave.cell(10.0 * unit(random), 0.01 + 0.1 * unit(random), limits);
        for (const unsigned moving : {0U, 1U}) {
            const long double use = jerk_from_rest(cell, moving, wide(cell.largest_from_rest(moving)));
            REQUIRE(use <= 1.0L + 1e-9L);
            least = std::min(least, use);
        }
    }
    CHECK(least > 0.7L);
}

TEST_CASE("on a straight line a cell from rest takes the time of constant jerk", "[feed_plan][jerk]") {
    const JerkCell<double> cell = Wave{{0.0, 0.0}, {1.0, 1.0}}.cell(0.0, 0.5, {1e9, 1000.0, 1e9});
    const double along = 1000.0 / std::cos(0.3); // the first axis has more to do
    const double t = std::cbrt(6.0 * 0.5 / along);
    CHECK(std::sqrt(cell.largest_from_rest(1)) == Approx(0.5 * along * t * t));
    CHECK(std::sqrt(cell.largest_from_rest(0)) == Approx(0.5 * along * t * t));
}

TEST_CASE("the limits of a move keep those of the axes, whatever the motion", "[feed_plan][jerk]") {
    std::mt19937 random{72};
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    CAPTURE("seed 72");
    for (int run = 0; run < 2000; ++run) {
        const Wave wave{{unit(random), unit(random)}, {2.0 * unit(random), 6.0 * unit(random)}};
        const JerkCell<double> cell = wave.cell(10.0 * unit(random), 0.01 + 0.1 * unit(random), {1000.0, 2e4, 1e4});
        const MoveLimits most = cell.move_limits(cell.cap_sq);
        REQUIRE(most.speed_mm_s * most.speed_mm_s <= cell.cap_sq * (1.0 + 1e-12));
        for (const auto& end : cell.end) {
            for (const unsigned k : indices(cell.limits.axes)) {
                const double v = most.speed_mm_s;
                const double a = std::fabs(end[k].first) * most.acceleration_mm_s2 + std::fabs(end[k].second) * v * v;
                const double j = std::fabs(end[k].first) * most.jerk_mm_s3 +
                                 3.0 * std::fabs(end[k].second) * v * most.acceleration_mm_s2;
                REQUIRE(a <= cell.limits.acceleration_mm_s2[k] * (1.0 + 1e-12));
                REQUIRE(j <= cell.limits.jerk_mm_s3[k] * (1.0 + 1e-12));
            }
        }
    }
    const JerkCell<double> straight = Wave{{0.0, 0.0}, {1.0, 1.0}}.cell(0.0, 0.5, {1000.0, 2e4, 1e4});
    CHECK(straight.straight(straight.cap_sq));
    const double steepest = std::max(std::fabs(straight.end[0][0].first), std::fabs(straight.end[0][1].first));
    CHECK(straight.move_limits(straight.cap_sq).jerk_mm_s3 == Approx(straight.limits.jerk_mm_s3[0] / steepest));
    CHECK_FALSE(Wave{{0.5, 0.5}, {3.0, 1.0}}.cell(5.0, 0.5, {1000.0, 2e4, 1e4}).straight(1e4));
}

TEST_CASE("below the line between most_sq an axis keeps its velocity all along the cell, and uses it",
          "[feed_plan][jerk]") {
    std::mt19937 random{72};
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    CAPTURE("seed 72");
    long double least = 1;
    int limited = 0;
    for (int trial = 0; trial < 5000; ++trial) {
        const Wave wave{{unit(random), unit(random)}, {2.0 * unit(random), 6.0 * unit(random)}};
        JerkCell<double> cell = wave.cell(10.0 * unit(random), 0.001 + 0.2 * unit(random), {.cap_sq = 1e4});
        cell.limits.velocity_mm_s = {20.0 + 100.0 * unit(random), 20.0 + 100.0 * unit(random)};
        for (const unsigned k : {0U, 1U}) {
            cell.limit_velocity(k, 0.0);
        }
        if (cell.most_sq[0] == JerkCell<double>::unlimited_sq) {
            continue;
        }
        ++limited;
        long double most = 0;
        for (int i = 0; i <= 50; ++i) {
            const long double x = i / 50.0L;
            const long double line = wide(cell.most_sq[0]) + x * (wide(cell.most_sq[1]) - wide(cell.most_sq[0]));
            const long double b = std::min(line, wide(cell.cap_sq));
            REQUIRE(b > 0.0L);
            for (const unsigned k : {0U, 1U}) {
                const long double d0 = wide(cell.end[0][k].second) * wide(cell.length_mm);
                const long double d1 = wide(cell.end[1][k].second) * wide(cell.length_mm);
                const long double rise = wide(cell.end[1][k].first) - wide(cell.end[0][k].first);
                const long double first =
                    wide(cell.end[0][k].first) + x * (d0 + x * (3 * rise - 2 * d0 - d1 + x * (d0 + d1 - 2 * rise)));
                most = std::max(most, std::abs(first) * std::sqrt(b) / wide(cell.limits.velocity_mm_s[k]));
            }
        }
        REQUIRE(most <= 1.0L + 1e-12L);
        least = std::min(least, most);
    }
    CHECK(limited > 500);
    CHECK(least > 0.7L);
}
