// SPDX-License-Identifier: MIT
//
// States from which the exits of a cell are reached, against motions through it that are tried at random.
#include "splinefeed/s3_feed_plan/jerk_optimal/controllable_set.hpp"

#include "support/catch.hpp"
#include "support/jerk_reference.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

constexpr std::uint32_t seed = 81;

struct Trial {
    JerkCell cell;
    CellPassage passage;
    ExpectedSpeeds expected;
    StatePolygon exits;
};

struct Trials {
    std::mt19937 random{seed};
    double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
    void next(Trial& trial) {
        const JerkLimits limits;
        const Wave wave{{between(0, 1), between(0, 0.5)}, {between(0, 2), between(0, 4)}};
        trial.cell = wave.cell(between(0, 10), between(0.05, 0.3), limits);
        trial.passage = {&trial.cell, between(0, 1) < 0.5};
        const double b = between(100.0, 4000.0);
        trial.expected = {b * between(0.8, 1.25), b};
        trial.exits = states_at(trial.passage, trial.passage, limits.cap_sq);
        trial.exits.cut({1.0, 0.0, b * 1.2});
        trial.exits.simplify();
    }
    SpeedState inside(const StatePolygon& polygon) {
        SpeedState sum{0.0, 0.0};
        double weights = 0.0;
        for (const SpeedState& corner : polygon.corners()) {
            const double weight = std::pow(between(0, 1), 3.0);
            sum = {sum.b + weight * corner.b, sum.slope + weight * corner.slope};
            weights += weight;
        }
        return {sum.b / weights, sum.slope / weights};
    }
};

// Of the way from the middle of the polygon to its border; more than 1: outside.
double outside(const StatePolygon& polygon, const SpeedState& state) {
    std::array<StateBound, StatePolygon::capacity + 4> sides;
    const std::size_t n = polygon.bounds(sides);
    SpeedState middle{0.0, 0.0};
    const auto size = static_cast<double>(polygon.corners().size());
    for (const SpeedState& corner : polygon.corners()) {
        middle = {middle.b + corner.b / size, middle.slope + corner.slope / size};
    }
    double most = n > 0 ? 0.0 : 1e9;
    for (std::size_t i = 0; i < n; ++i) {
        const double room = -sides[i].excess(middle);
        most = room > 0.0 ? std::max(most, 1.0 + sides[i].excess(state) / room) : most;
    }
    return most;
}

// Of the cell as it lies, for a motion through it in the direction of the passage.
JerkUse use_of(const Trial& trial, const SpeedState& entry, double u) {
    if (!trial.passage.backward) {
        return splinefeed_test::use_of(trial.cell, wide(entry.b), wide(entry.slope), wide(u));
    }
    const SpeedState exit = travelled(entry, u, trial.cell.length_mm);
    return splinefeed_test::use_of(trial.cell, wide(exit.b), -wide(exit.slope), wide(u));
}

} // namespace

TEST_CASE("from every state inside some motion leads to an exit, within the limits all along the cell",
          "[feed_plan][jerk]") {
    Trials trials;
    CAPTURE(seed);
    Trial trial;
    int tried = 0;
    long double most = 0;
    for (int i = 0; i < 1000; ++i) {
        trials.next(trial);
        const ControllableSet reach(trial.passage, trial.expected);
        StatePolygon entries = reach.from(trial.exits);
        if (!entries.empty()) {
            cut_to_node(entries, trial.passage, trial.passage, JerkLimits{}.cap_sq);
        }
        for (int j = 0; j < 20 && entries.corners().size() > 2; ++j) {
            const SpeedState entry = trials.inside(entries);
            const CurvatureRange range = reach.range(entry, trial.exits);
            REQUIRE(range.low <= range.high + 1e-9 * std::abs(range.high) + 1e-3);
            for (const double u : {range.low, range.high, 0.5 * (range.low + range.high)}) {
                const JerkUse use = use_of(trial, entry, u);
                REQUIRE(use.jerk <= 1.0L + 1e-6L);
                REQUIRE(outside(trial.exits, travelled(entry, u, trial.cell.length_mm)) <= 1.0 + 1e-6);
                most = std::max(most, use.jerk);
                ++tried;
            }
            // The acceleration is the cell's inside and the nodes' at its ends; with states_at() as exits both hold.
            REQUIRE(use_of(trial, entry, range.high).acceleration <= 1.0L + 1e-6L);
        }
    }
    CHECK(tried > 10000);
    CHECK(most > 0.98L);
}

TEST_CASE("few states are left out from which an exit is reached, and none by the range of u", "[feed_plan][jerk]") {
    Trials trials;
    CAPTURE(seed);
    Trial trial;
    int reached = 0;
    int left_out = 0;
    for (int i = 0; i < 1000; ++i) {
        trials.next(trial);
        const ControllableSet reach(trial.passage, trial.expected);
        const StatePolygon entries = reach.from(trial.exits);
        const double l = trial.cell.length_mm;
        for (int j = 0; j < 20; ++j) {
            const SpeedState exit = trials.inside(trial.exits);
            const double steep = 2.0 * JerkLimits{}.jerk / std::sqrt(std::max(exit.b, 1.0));
            const double u = trials.between(-steep, steep);
            const SpeedState entry{exit.b - (exit.slope - 0.5 * u * l) * l, exit.slope - u * l};
            const CurvatureRange range = reach.range(entry, trial.exits);
            if (range.low > u || range.high < u) { // beyond the tangents of the limits
                continue;
            }
            ++reached;
            left_out += outside(entries, entry) > 1.0 + 1e-6;
        }
    }
    CAPTURE(reached, left_out);
    CHECK(reached > 3000);
    CHECK(left_out < reached / 100);
}

TEST_CASE("what keeps the limits all along the cell with a twentieth to spare is allowed", "[feed_plan][jerk]") {
    Trials trials;
    CAPTURE(seed);
    Trial trial;
    int within = 0;
    int allowed = 0;
    for (int i = 0; i < 3000; ++i) {
        trials.next(trial);
        const ControllableSet reach(trial.passage, trial.expected);
        const double l = trial.cell.length_mm;
        for (int j = 0; j < 20; ++j) {
            const SpeedState exit = trials.inside(trial.exits);
            const double steep = 2.0 * JerkLimits{}.jerk / std::sqrt(std::max(exit.b, 1.0));
            const double u = trials.between(-steep, steep);
            const SpeedState entry{exit.b - (exit.slope - 0.5 * u * l) * l, exit.slope - u * l};
            const auto expected = [](double b, double of) { // nearly; what is far from that is taken for more
                return std::abs(b - of) < 0.2 * of;
            };
            if (!expected(entry.b, trial.expected.entry_sq) || !expected(exit.b, trial.expected.exit_sq)) {
                continue;
            }
            const JerkUse use = use_of(trial, entry, u);
            if (use.jerk <= 0.95L && use.acceleration <= 0.95L) {
                const CurvatureRange range = reach.range(entry, trial.exits);
                ++within;
                allowed += range.low <= u && u <= range.high ? 1 : 0;
            }
        }
    }
    CAPTURE(within, allowed);
    CHECK(within > 300);
    CHECK(allowed > within - within / 50);
}

TEST_CASE("the states of a node are those with speeds and accelerations that both its cells allow",
          "[feed_plan][jerk]") {
    Trials trials;
    CAPTURE(seed);
    int allowed = 0;
    for (int i = 0; i < 300; ++i) {
        const Wave wave{{trials.between(0, 1), trials.between(0, 0.5)}, {trials.between(0, 2), trials.between(0, 4)}};
        const double at = trials.between(0, 10);
        const double lengths[] = {trials.between(0.05, 1.0), trials.between(0.05, 1.0)};
        JerkCell cells[] = {wave.cell(at - lengths[0], lengths[0], JerkLimits{}),
                            wave.cell(at, lengths[1], JerkLimits{})};
        cells[0].cap_sq = trials.between(100.0, 10000.0);
        cells[1].cap_sq = trials.between(100.0, 10000.0);
        const double most = trials.between(50.0, 10000.0);
        const StatePolygon states = states_at({cells, false}, {cells + 1, false}, most);
        // The largest part that is used of what it is between; b of a parabola from 0 to the cap has a middle of its
        // Bezier points between them, too, whatever is at the other end
        const auto used = [&](const SpeedState& state) {
            double part =
                std::max({std::abs(2.0 * state.b / std::min({most, cells[0].cap_sq, cells[1].cap_sq}) - 1.0),
                          std::abs(2.0 * (state.b - 0.5 * state.slope * lengths[0]) / cells[0].cap_sq - 1.0),
                          std::abs(2.0 * (state.b + 0.5 * state.slope * lengths[1]) / cells[1].cap_sq - 1.0)});
            for (const AxisEnd& end : cells[1].end[0]) {
                const double acceleration = end.second * state.b + 0.5 * end.first * state.slope;
                part = std::max(part, std::abs(acceleration) / JerkLimits{}.acceleration);
            }
            return part;
        };
        for (const SpeedState& corner : states.corners()) {
            REQUIRE(used(corner) <= 1.0 + 1e-6);
        }
        for (int j = 0; j < 200; ++j) {
            const SpeedState state{trials.between(0.0, most), trials.between(-1.0, 1.0) * 2.0 * most / lengths[j % 2]};
            if (used(state) < 1.0 - 1e-6) {
                REQUIRE(outside(states, state) <= 1.0);
                ++allowed;
            }
        }
    }
    CHECK(allowed > 1000);
}

TEST_CASE("where nothing is expected but rest, no exit in motion is reached", "[feed_plan][jerk]") {
    Trials trials;
    Trial trial;
    trials.next(trial);
    trial.exits.cut({-1.0, 0.0, -50.0});
    REQUIRE(!trial.exits.empty());
    CHECK(ControllableSet(trial.passage, {0.0, 0.0}).from(trial.exits).empty());
}
