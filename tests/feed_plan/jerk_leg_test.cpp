// SPDX-License-Identifier: MIT
//
// Motions of whole legs: the limits at many points of every cell, in long double, and the time on a straight line.
#include "splinefeed/s3_feed_plan/jerk_optimal/leg_attempts.hpp"

#include "support/catch.hpp"
#include "support/jerk_reference.hpp"

#include <vector>

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

constexpr std::uint32_t seed = 91;
constexpr double about = 1e-3; // of a time that motions are compared by

std::vector<JerkNode> leg_along(const Wave& wave, double start, std::size_t cells, double length,
                                const JerkLimits& limits) {
    std::vector<JerkNode> nodes(cells + 1);
    for (std::size_t i = 0; i < cells; ++i) {
        // Short cells at both ends, as next to a stop.
        const std::size_t near = std::min(i, cells - 1 - i);
        const double step = near < 10 ? length * std::exp2(0.5 * (static_cast<double>(near) - 10.0)) : length;
        nodes[i].cell = wave.cell(start, step, limits);
        start += step;
    }
    // What acceleration alone allows, about: from both ends and in bends.
    const double steepest = 2.0 * std::sqrt(2.0) * limits.acceleration;
    double from_start = 0.0;
    for (std::size_t i = 0; i < cells; ++i) {
        const auto& end = nodes[i].cell.end[0];
        const double bend = std::hypot(end[0].second, end[1].second);
        nodes[i].at_most_sq = std::min(limits.cap_sq, steepest * from_start);
        nodes[i].at_most_sq = std::min(nodes[i].at_most_sq, 0.5 * steepest / std::max(bend, 1e-6));
        from_start += nodes[i].cell.length_mm;
    }
    double to_end = 0.0;
    for (std::size_t i = cells; i-- > 0;) {
        to_end += nodes[i].cell.length_mm;
        nodes[i].expected_sq = nodes[i].at_most_sq = std::min(nodes[i].at_most_sq, steepest * to_end);
    }
    nodes[cells].at_most_sq = nodes[cells].expected_sq = 0.0;
    return nodes;
}

// Checks a plan; returns the time that it takes.
double checked(const std::vector<JerkNode>& nodes, bool moving) {
    const std::size_t n = nodes.size() - 1;
    double time = 0.0;
    REQUIRE(nodes[n].state.b == 0.0);
    REQUIRE(nodes[n].state.slope == 0.0);
    for (std::size_t i = 0; i < n; ++i) {
        const SpeedState& from = nodes[i].state;
        const SpeedState& to = nodes[i + 1].state;
        const JerkCell& cell = nodes[i].cell;
        const double l = cell.length_mm;
        CAPTURE(i, n, from.b, from.slope, to.b, to.slope);
        if ((i == 0 && !moving) || i + 1 == n) {
            const SpeedState& end = i == 0 ? to : from;
            REQUIRE(end.b > 0.0);
            REQUIRE(end.b <= cell.largest_from_rest(i == 0 ? 1 : 0) * (1.0 + 1e-9));
            REQUIRE(std::abs(end.slope) == Approx(4.0 * end.b / (3.0 * l)));
            time += 3.0 * l / std::sqrt(end.b);
            continue;
        }
        // A parabola: the mean of both slopes leads from one end to the other.
        REQUIRE(std::abs(to.b - from.b - 0.5 * l * (from.slope + to.slope)) <= 1e-7 * (1.0 + from.b + to.b));
        const double u = (to.slope - from.slope) / l;
        const JerkUse use = use_of(cell, wide(from.b), wide(from.slope), wide(u));
        REQUIRE(use.jerk <= 1.0L + 1e-5L);
        REQUIRE(use.acceleration <= 1.0L + 1e-7L);
        REQUIRE(use.speed_sq <= 1.0L + 1e-9L);
        REQUIRE(use.least_sq >= -1e-9L);
        for (int k = 0; k < 20; ++k) {
            const double s = l * (k + 0.5) / 20.0;
            time += l / 20.0 / std::sqrt(from.b + s * (from.slope + 0.5 * s * u));
        }
    }
    return time;
}

} // namespace

TEST_CASE("legs along curves keep every limit, from rest and in motion", "[feed_plan][jerk]") {
    std::mt19937 random{seed};
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    CAPTURE(seed);
    int moving_plans = 0;
    for (int trial = 0; trial < 20; ++trial) {
        CAPTURE(trial);
        JerkLimits limits;
        limits.jerk = 20000.0 + 80000.0 * unit(random);
        const Wave wave{{unit(random), 0.5 * unit(random)}, {unit(random), 2.0 * unit(random)}};
        const double length = 0.1 + 0.1 * unit(random);
        std::vector<JerkNode> nodes = leg_along(wave, 0.0, 120, length, limits);
        JerkLeg whole(nodes, nullptr, 0);
        REQUIRE(whole.plan());
        CHECK(whole.seconds() == Approx(checked(nodes, false)).epsilon(about));

        // From the middle of the plan on, with what is known of it.
        std::vector<JerkNode> rest(nodes.begin() + 40, nodes.end());
        const SpeedState start = rest.front().state;
        if (JerkLeg leg(rest, &start, rest.size() - 1); leg.plan()) {
            REQUIRE(rest.front().state.b == Approx(start.b));
            REQUIRE(rest.front().state.slope == Approx(start.slope));
            CHECK(leg.seconds() == Approx(checked(rest, true)).epsilon(about));
            ++moving_plans;
        }
    }
    CHECK(moving_plans >= 19);
}

TEST_CASE("a straight line takes the time of the seven phases, and little more", "[feed_plan][jerk]") {
    const Wave line{{0.0, 0.0}, {1.0, 1.0}};
    const double share = std::cos(0.3); // of the axis that has most to do
    JerkLimits limits;
    limits.acceleration = 1000.0;
    limits.jerk = 20000.0;
    limits.cap_sq = 10000.0;
    for (const std::size_t cells : {80U, 200U}) {
        std::vector<JerkNode> nodes = leg_along(line, 0.0, cells, 0.25, limits);
        double distance = 0.0;
        for (std::size_t i = 0; i < cells; ++i) {
            distance += nodes[i].cell.length_mm;
        }
        const double jerk = limits.jerk / share;
        const double acceleration = limits.acceleration / share;
        // With the largest acceleration reached, and the speed v = 100 mm/s or what the distance allows.
        const double phase = acceleration / jerk;
        const double most = -0.5 * acceleration * phase +
                            std::sqrt(0.25 * acceleration * acceleration * phase * phase + acceleration * distance);
        const double v = std::min(100.0, most);
        const double time = distance / v + v / acceleration + phase;
        REQUIRE(JerkLeg(nodes, nullptr, 0).plan());
        const double took = checked(nodes, false);
        CAPTURE(cells, distance, time, took);
        CHECK(took >= time * (1.0 - 1e-3));
        CHECK(took <= time * 1.03);
    }
}

TEST_CASE("a leg from rest where much more was expected", "[feed_plan][jerk]") {
    // As after a hold: nothing in the speeds of the acceleration-limited plan says that the leg begins at rest.
    std::mt19937 random(seed + 1);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    int alone = 0;
    for (int trial = 0; trial < 20; ++trial) {
        CAPTURE(seed, trial);
        const JerkLimits limits{1000.0, 20000.0, 10000.0};
        const Wave wave{{unit(random), 0.5 * unit(random)}, {unit(random), 2.0 * unit(random)}};
        std::vector<JerkNode> nodes = leg_along(wave, 0.0, 120, 0.1 + 0.1 * unit(random), limits);
        for (std::size_t i = 0; i < nodes.size() / 2; ++i) {
            nodes[i].at_most_sq = nodes[i].expected_sq = nodes[nodes.size() / 2].at_most_sq;
            nodes[i].most_sq = limits.cap_sq;
        }
        std::vector<JerkNode> once = nodes;
        alone += JerkLeg(once, nullptr, 0).plan() ? 1 : 0;
        REQUIRE(plan_leg(nodes, 0));
        checked(nodes, false);
    }
    CHECK(alone < 20); // so it matters
}
