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
template <class R>
constexpr double rounding = std::is_same_v<R, double> ? 1e-7 : 4e-6; // of lengths and speeds

struct Leg {
    std::vector<JerkCell<double>> cells;
    std::vector<double> at_most_sq; // at the end of each
};

/// A plan of the leg from cell `first` on, and its memory.
template <class R>
struct Planned {
    explicit Planned(const Leg& leg, const SpeedState& start = {0.0, 0.0}, std::size_t first = 0,
                     const std::vector<double>& known = {})
        : nodes(leg.cells.size() + 1), plan(nodes) {
        plan.begin(start);
        for (std::size_t i = first; i < leg.cells.size(); ++i) {
            plan.add(cell_in<R>(leg.cells[i]), static_cast<R>(leg.at_most_sq[i]));
            if (!known.empty()) {
                plan.know(static_cast<R>(known[i]));
            }
        }
    }
    /// b at the start of every cell, and 0; the middles.
    void read() {
        b.assign(plan.cells() + 1, 0.0);
        middle_sq.assign(plan.cells(), 0.0);
        plan.each_cell([&](std::size_t i, double b_i, double m_i) {
            b[i] = b_i;
            middle_sq[i] = m_i;
        });
    }

    std::vector<LegNode<R>> nodes;
    LegPlan<R> plan;
    std::vector<double> b;
    std::vector<double> middle_sq;
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
    for (const JerkCell<double>& cell : leg.cells) {
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
template <class R>
double checked(const Leg& leg, Planned<R>& planned, std::size_t first, bool moving) {
    planned.read();
    const std::size_t n = planned.plan.cells();
    double time = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const double b = planned.b[i];
        const double next = planned.b[i + 1];
        const JerkCell<double>& cell = leg.cells[first + i];
        const double l = cell.length_mm;
        CAPTURE(i, n, b, planned.middle_sq[i], next);
        if ((i == 0 && !moving) || i + 1 == n) {
            const double end = i == 0 ? next : b;
            REQUIRE(end > 0.0);
            REQUIRE(end <= cell.largest_from_rest(i == 0 ? 1 : 0) * (1.0 + rounding<R>));
            time += 3.0 * l / std::sqrt(end);
            continue;
        }
        const double slope = 2.0 * (planned.middle_sq[i] - b) / l;
        const double u = 2.0 * (b - 2.0 * planned.middle_sq[i] + next) / (l * l);
        const JerkUse use = use_of(cell, wide(b), wide(slope), wide(u));
        REQUIRE(use.jerk <= 1.0L + 1e-9L);
        REQUIRE(use.acceleration <= 1.0L + 1e-9L);
        REQUIRE(use.speed_sq <= 1.0L + wide(rounding<R>));
        REQUIRE(use.least_sq > 0.0L);
        // b and b' of the next cell follow.
        if (i + 2 < n) {
            const double next_slope = 2.0 * (planned.middle_sq[i + 1] - next) / leg.cells[first + i + 1].length_mm;
            REQUIRE(next_slope == Approx(slope + u * l).margin(rounding<R> * (b + next) / l));
        }
        for (int k = 0; k < 20; ++k) {
            const double s = l * (k + 0.5) / 20.0;
            time += l / 20.0 / std::sqrt(b + s * (slope + 0.5 * s * u));
        }
    }
    return time;
}

} // namespace

TEMPLATE_TEST_CASE("legs along curves keep every limit, from rest and in motion", "[feed_plan][jerk]", double, float) {
    std::mt19937 random{seed};
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    CAPTURE(seed);
    int moving_plans = 0;
    for (int trial = 0; trial < 40; ++trial) {
        CAPTURE(trial);
        JerkLimits limits;
        limits.jerk = 20000.0 + 80000.0 * unit(random);
        const Wave wave{{unit(random), 0.5 * unit(random)}, {unit(random), 2.0 * unit(random)}};
        const Leg leg = leg_along(wave, 0.0, 120, 0.1 + 0.1 * unit(random), limits);
        Planned<TestType> whole(leg);
        REQUIRE(whole.plan.fastest());
        const double whole_s = checked(leg, whole, 0, false);

        // From the middle of the plan on, with what is known of it.
        constexpr std::size_t first = 40;
        const double start = whole.b[first];
        Planned<TestType> rest(leg, {start, 2.0 * (whole.middle_sq[first] - start) / leg.cells[first].length_mm}, first,
                               whole.middle_sq);
        if (!rest.plan.fastest()) {
            continue;
        }
        ++moving_plans;
        const double rest_s = checked(leg, rest, first, true);
        CHECK(rest.b[0] == start);
        CHECK(rest.middle_sq[0] == Approx(whole.middle_sq[first]));
        CHECK(rest_s < whole_s);
    }
    CHECK(moving_plans >= 39);
}

// A servo period may end behind each of them.
TEST_CASE("a step of a search solves and proves a part of a long leg", "[feed_plan][jerk]") {
    const Wave wave{{1.0, 0.5}, {1.0, 2.0}};
    const JerkLimits limits{1000.0, 30000.0, 10000.0};
    Planned<double> leg(leg_along(wave, 0.0, 170, 0.1, limits));
    leg.plan.search();
    Search search = leg.plan.step(); // the guess, of all of it
    std::size_t solved = 0;          // most in a step
    std::size_t proved = 0;
    while (search == Search::running) {
        const std::vector<LegNode<double>> before = leg.nodes;
        search = leg.plan.step();
        std::size_t gains = 0;
        std::size_t multipliers = 0;
        std::size_t shares = 0;
        for (std::size_t i = 0; i < before.size(); ++i) {
            const LegNode<double>& node = leg.nodes[i];
            gains += node.gain != before[i].gain ? 1U : 0U;
            multipliers += node.cap_multiplier != before[i].cap_multiplier ? 1U : 0U;
            shares += node.jerk_share != before[i].jerk_share ? 1U : 0U;
        }
        solved = std::max({solved, gains, multipliers});
        proved = std::max(proved, shares);
    }
    CHECK(search == Search::found);
    CHECK(solved > 0);
    CHECK(solved <= LegSolver<double>::most_nodes);
    CHECK(proved > 0);
    CHECK(proved <= LegPlan<double>::most_proved);
}

TEST_CASE("a straight line takes the time of the seven phases, and little more", "[feed_plan][jerk]") {
    const Wave line{{0.0, 0.0}, {1.0, 1.0}};
    const double share = std::cos(0.3); // of the axis that has most to do
    const JerkLimits limits{1000.0, 20000.0, 10000.0};
    for (const std::size_t cells : {80U, 200U}) {
        const Leg leg = leg_along(line, 0.0, cells, 0.25, limits);
        double distance = 0.0;
        for (const JerkCell<double>& cell : leg.cells) {
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
        Planned<double> plan(leg);
        REQUIRE(plan.plan.fastest());
        const double took = checked(leg, plan, 0, false);
        CAPTURE(cells, distance, time, took);
        CHECK(took >= time * (1.0 - 1e-6));
        CHECK(took <= time * 1.02);
    }
}

TEMPLATE_TEST_CASE("a motion that is possible is found where nothing is known of the leg", "[feed_plan][jerk]", double,
                   float) {
    std::mt19937 random(seed + 1);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int trial = 0; trial < 40; ++trial) {
        CAPTURE(seed, trial);
        const JerkLimits limits{1000.0, 20000.0 * std::exp2(8.0 * unit(random)), 10000.0};
        const Wave wave{{unit(random), 0.5 * unit(random)}, {unit(random), 2.0 * unit(random)}};
        Leg leg = leg_along(wave, 0.0, 60 + 10 * static_cast<std::size_t>(trial), 0.1 + 0.1 * unit(random), limits);
        std::ranges::fill(leg.at_most_sq, 0.0);
        Planned<TestType> slow(leg);
        REQUIRE(slow.plan.slow());
        const double slow_s = checked(leg, slow, 0, false);
        Planned<TestType> fast(leg);
        REQUIRE(fast.plan.fastest());
        CHECK(checked(leg, fast, 0, false) < slow_s);
    }
}

TEST_CASE("middles below their caps keep v^2 below the lines that the velocities allow, in every cell",
          "[feed_plan][jerk]") {
    std::mt19937 random{seed};
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    CAPTURE("seed 91");
    double nearest = 0.0; // to the line at a node, of it
    for (int trial = 0; trial < 500; ++trial) {
        std::vector<LegNode<double>> nodes(13);
        LegPlan<double> plan(nodes);
        plan.begin({0.0, 0.0});
        std::vector<JerkCell<double>> cells(12);
        double line = 100.0;
        for (JerkCell<double>& cell : cells) {
            cell.limits.axes = 1;
            cell.limits.jerk_mm_s3[0] = cell.limits.acceleration_mm_s2[0] = 1e9;
            cell.length_mm = std::exp2(-8.0 * unit(random));
            cell.cap_sq = 1e9;
            line = unit(random) < 0.2 ? 10.0 + 1000.0 * unit(random) : line; // the velocities need not be continuous
            cell.most_sq = {line, line * (0.6 + 0.8 * unit(random))};
            line = cell.most_sq[1];
            plan.add(cell, 0.0);
        }
        for (std::size_t i = 0; i < cells.size(); ++i) {
            REQUIRE(nodes[i].cap_sq > 0.0);
            REQUIRE(nodes[i].cap_sq <= 0.5 * (cells[i].most_sq[0] + cells[i].most_sq[1]));
            if (i > 0) { // b there lies between the middles beside it
                const double before = cells[i - 1].length_mm;
                const double behind = cells[i].length_mm;
                const double b = (behind * nodes[i - 1].cap_sq + before * nodes[i].cap_sq) / (before + behind);
                const double most = std::min(cells[i - 1].most_sq[1], cells[i].most_sq[0]);
                REQUIRE(b <= most * (1.0 + 1e-12));
                nearest = std::max(nearest, b / most);
            }
        }
    }
    CHECK(nearest > 0.999);
}
