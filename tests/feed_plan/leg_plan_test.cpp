// SPDX-License-Identifier: MIT
//
// Motions of whole legs: the limits at many points of every cell, in long double, and the time on a straight line.
#include "splinefeed/s3_feed_plan/jerk/leg_plan.hpp"

#include "support/catch.hpp"
#include "support/jerk_reference.hpp"

#include <vector>

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

constexpr std::uint32_t seed = 91;
constexpr double about = 1e-3; // of a time that motions are compared by

struct Leg {
    std::vector<JerkCell> cells;
    std::vector<double> at_most_sq; // at the end of each
    std::vector<LegNode<double>> nodes;

    [[nodiscard]] LegPlan begin(const SpeedState& start, std::size_t first = 0) {
        nodes.resize(cells.size() + 1);
        LegPlan plan(nodes);
        plan.begin(start);
        for (std::size_t i = first; i < cells.size(); ++i) {
            plan.add(cells[i], at_most_sq[i]);
        }
        return plan;
    }
};

Leg leg_along(const Wave& wave, double start, std::size_t count, double length, const JerkLimits& limits) {
    Leg leg;
    for (std::size_t i = 0; i < count; ++i) {
        // Short cells at both ends, as next to a stop.
        const std::size_t near = std::min(i, count - 1 - i);
        const double step = near < 10 ? length * std::exp2(0.5 * (static_cast<double>(near) - 10.0)) : length;
        leg.cells.push_back(wave.cell(start, step, limits));
        start += step;
    }
    // What acceleration alone allows, about: from both ends and in bends.
    const double steepest = 2.0 * std::sqrt(2.0) * limits.acceleration;
    double from_start = 0.0;
    for (const JerkCell& cell : leg.cells) {
        from_start += cell.length_mm;
        const auto& end = cell.end[1];
        const double bend = std::max(std::hypot(end[0].second, end[1].second), 1e-6);
        leg.at_most_sq.push_back(std::min({limits.cap_sq, steepest * from_start, 0.5 * steepest / bend}));
    }
    double to_end = 0.0;
    for (std::size_t i = count; i-- > 0;) {
        leg.at_most_sq[i] = std::min(leg.at_most_sq[i], steepest * to_end);
        to_end += leg.cells[i].length_mm;
    }
    return leg;
}

// Checks a plan of the cells from `first` on; returns the time that it takes.
double checked(const Leg& leg, const LegPlan& plan, std::size_t first, bool moving) {
    const std::size_t n = plan.cells();
    double time = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const LegNode<double>& node = plan.node(i);
        const double next = i + 1 < n ? plan.node(i + 1).b : 0.0;
        const JerkCell& cell = leg.cells[first + i];
        const double l = cell.length_mm;
        CAPTURE(i, n, node.b, node.middle_sq, next);
        if ((i == 0 && !moving) || i + 1 == n) {
            const double b = i == 0 ? next : node.b;
            REQUIRE(b > 0.0);
            REQUIRE(b <= cell.largest_from_rest(i == 0 ? 1 : 0) * (1.0 + 1e-9));
            time += 3.0 * l / std::sqrt(b);
            continue;
        }
        const double slope = 2.0 * (node.middle_sq - node.b) / l;
        const double u = 2.0 * (node.b - 2.0 * node.middle_sq + next) / (l * l);
        const JerkUse use = use_of(cell, wide(node.b), wide(slope), wide(u));
        REQUIRE(use.jerk <= 1.0L + 1e-9L);
        REQUIRE(use.acceleration <= 1.0L + 1e-9L);
        REQUIRE(use.speed_sq <= 1.0L + 1e-9L);
        REQUIRE(use.least_sq > 0.0L);
        // b and b' of the next cell follow.
        if (i + 2 < n) {
            const LegNode<double>& after = plan.node(i + 1);
            const double next_slope = 2.0 * (after.middle_sq - after.b) / leg.cells[first + i + 1].length_mm;
            REQUIRE(next_slope == Approx(slope + u * l).margin(1e-7 * (node.b + next) / l));
        }
        for (int k = 0; k < 20; ++k) {
            const double s = l * (k + 0.5) / 20.0;
            time += l / 20.0 / std::sqrt(node.b + s * (slope + 0.5 * s * u));
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
    for (int trial = 0; trial < 40; ++trial) {
        CAPTURE(trial);
        JerkLimits limits;
        limits.jerk = 20000.0 + 80000.0 * unit(random);
        const Wave wave{{unit(random), 0.5 * unit(random)}, {unit(random), 2.0 * unit(random)}};
        Leg leg = leg_along(wave, 0.0, 120, 0.1 + 0.1 * unit(random), limits);
        LegPlan whole = leg.begin({0.0, 0.0});
        REQUIRE(whole.fastest());
        CHECK(whole.seconds() == Approx(checked(leg, whole, 0, false)).epsilon(about));

        // From the middle of the plan on, with what is known of it, and with nothing.
        constexpr std::size_t first = 40;
        const SpeedState start{whole.node(first).b, whole.node(first).slope};
        std::vector<double> known;
        for (std::size_t i = first; i < leg.cells.size(); ++i) {
            known.push_back(whole.node(i).middle_sq);
        }
        const double whole_s = whole.seconds();
        LegPlan rest(leg.nodes);
        rest.begin(start);
        for (std::size_t i = first; i < leg.cells.size(); ++i) {
            rest.add(leg.cells[i], leg.at_most_sq[i]);
            rest.know(known[i - first]);
        }
        if (!rest.fastest()) {
            continue;
        }
        ++moving_plans;
        CHECK(rest.node(0).b == start.b);
        CHECK(rest.node(0).slope == start.slope);
        CHECK(rest.seconds() == Approx(checked(leg, rest, first, true)).epsilon(about));
        CHECK(rest.seconds() < whole_s);
    }
    CHECK(moving_plans >= 39);
}

TEST_CASE("a straight line takes the time of the seven phases, and little more", "[feed_plan][jerk]") {
    const Wave line{{0.0, 0.0}, {1.0, 1.0}};
    const double share = std::cos(0.3); // of the axis that has most to do
    const JerkLimits limits{1000.0, 20000.0, 10000.0};
    for (const std::size_t cells : {80U, 200U}) {
        Leg leg = leg_along(line, 0.0, cells, 0.25, limits);
        double distance = 0.0;
        for (const JerkCell& cell : leg.cells) {
            distance += cell.length_mm;
        }
        const double jerk = limits.jerk / share;
        const double acceleration = limits.acceleration / share;
        // With the largest acceleration reached, and the speed v = 100 mm/s or what the distance allows.
        const double phase = acceleration / jerk;
        const double most = -0.5 * acceleration * phase +
                            std::sqrt(0.25 * acceleration * acceleration * phase * phase + acceleration * distance);
        const double v = std::min(100.0, most);
        const double time = distance / v + v / acceleration + phase;
        LegPlan plan = leg.begin({0.0, 0.0});
        REQUIRE(plan.fastest());
        const double took = checked(leg, plan, 0, false);
        CAPTURE(cells, distance, time, took);
        CHECK(took >= time * (1.0 - 1e-6));
        CHECK(took <= time * 1.02);
    }
}

TEST_CASE("a motion that is possible is found where nothing is known of the leg", "[feed_plan][jerk]") {
    std::mt19937 random(seed + 1);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int trial = 0; trial < 40; ++trial) {
        CAPTURE(seed, trial);
        const JerkLimits limits{1000.0, 20000.0 * std::exp2(8.0 * unit(random)), 10000.0};
        const Wave wave{{unit(random), 0.5 * unit(random)}, {unit(random), 2.0 * unit(random)}};
        Leg leg = leg_along(wave, 0.0, 60 + 10 * static_cast<std::size_t>(trial), 0.1 + 0.1 * unit(random), limits);
        std::ranges::fill(leg.at_most_sq, 0.0);
        LegPlan slow = leg.begin({0.0, 0.0});
        REQUIRE(slow.slow());
        const double slow_s = checked(leg, slow, 0, false);
        LegPlan fast = leg.begin({0.0, 0.0});
        REQUIRE(fast.fastest());
        CHECK(checked(leg, fast, 0, false) < slow_s);
    }
}
