// SPDX-License-Identifier: MIT
#include "splinefeed/s3_feed_plan/acceleration/speed_caps.hpp"

#include "support/catch.hpp"
#include "support/random_steering.hpp"

using namespace splinefeed_test;

namespace {

MachineSettings two_axes() {
    return machine_of(2, 80.0, 1000.0, 100.0);
}

/// A straight cell in this direction that bends by so much.
Cell<double> cell_along(double x, double y, double curvature_per_mm = 0.0) {
    Cell<double> cell;
    cell.axes = 2;
    cell.length_mm = 0.1;
    cell.tangent_max[0] = x;
    cell.tangent_max[1] = y;
    cell.shape[0].tangent = {x, x};
    cell.shape[1].tangent = {y, y};
    cell.curvature_max[0] = curvature_per_mm;
    cell.steady_mm_s = largest<double>();
    return cell;
}

double cap_of(const MachineSettings& machine, const Cell<double>& cell) {
    const auto limits = MotionLimits<double>::make(machine).value();
    return std::sqrt(SpeedCaps<double>(limits).cap(cell).least_sq());
}

} // namespace

TEST_CASE("the cap of a cell is the smallest of its limits", "[caps]") {
    MachineSettings machine = two_axes();
    CHECK(cap_of(machine, cell_along(0.6, 0.8)) == Approx(100.0).epsilon(1e-4)); // feed: 80 / 0.8
    CHECK(cap_of(machine, cell_along(1.0, 0.1)) == Approx(80.0).epsilon(1e-4));  // the axis's velocity
    Cell<double> block = cell_along(0.6, 0.8);
    block.max_feed_mm_s = 30.0;
    CHECK(cap_of(machine, block) == Approx(30.0).epsilon(1e-4));
    Cell<double> rounded = cell_along(0.6, 0.8);
    rounded.steady_mm_s = 7.0;
    CHECK(cap_of(machine, rounded) == Approx(7.0).epsilon(1e-4));
    machine.centripetal_mm_s2 = 200.0;
    CHECK(cap_of(machine, cell_along(0.6, 0.8, 0.5)) == Approx(20.0).epsilon(1e-4)); // sqrt(200 / 0.5)
}

TEST_CASE("below the cap an axis keeps its velocity all along a cell that turns, and uses it", "[caps]") {
    MachineSettings machine = two_axes();
    machine.max_feed_mm_s = 500.0;
    machine.axis[1].max_velocity_mm_s = 500.0;
    const auto limits = MotionLimits<double>::make(machine).value();
    const double velocity = limits.velocity_mm_s[0];
    for (const double to : {0.3, 0.45, 0.55, 0.6, 0.7, 0.8, -0.55}) {
        const double from = to < 0.0 ? -0.6 : 0.6;
        Cell<double> cell = cell_along(std::max(std::fabs(from), std::fabs(to)), 0.7);
        cell.shape[0].tangent = {from, to};
        cell.shape[0].bend.fill(2.0 * (to - from)); // q' is linear
        const CapLine<double> cap = SpeedCaps<double>(limits).cap(cell);
        CAPTURE(to, cap.entry_sq, cap.exit_sq);
        double most = 0.0;
        for (int i = 0; i <= 20; ++i) {
            const double x = i / 20.0;
            const double speed = std::sqrt(cap.entry_sq + x * (cap.exit_sq - cap.entry_sq));
            most = std::max(most, std::fabs(from + x * (to - from)) * speed);
        }
        CHECK(most <= velocity * (1.0 + 1e-12));
        CHECK(most >= velocity * (1.0 - 1e-12));
        const double steep = std::fabs(to - from) / (0.5 * std::fabs(to + from));
        CHECK((cap.entry_sq == cap.exit_sq) == (steep >= 0.5 || to == from));
    }
}

TEST_CASE("in a turn too sharp for the polynomials of a cell, half of the acceleration is what bends", "[caps]") {
    MachineSettings machine = two_axes();
    machine.axis[0].max_braking_mm_s2 = 500.0; // the smaller one, whichever way the axis moves
    const double sharp_per_mm = 10.0;          // turns by 1 rad in a cell of 0.1 mm
    CHECK(cap_of(machine, cell_along(0.6, 0.8, sharp_per_mm)) == Approx(std::sqrt(250.0 / sharp_per_mm)).epsilon(1e-4));
    const double gentle_per_mm = 2.0;
    CHECK(cap_of(machine, cell_along(0.6, 0.8, gentle_per_mm)) == Approx(100.0).epsilon(1e-4));
}

TEST_CASE("what is wanted is the programmed feed, with its override, up to the cap", "[caps]") {
    const auto limits = MotionLimits<double>::make(two_axes()).value();
    const SpeedCaps<double> caps(limits);
    Cell<double> cell = cell_along(0.6, 0.8);
    const double cap = caps.cap(cell).least_sq();
    CHECK(caps.wanted_sq(cell, cap, {}) == cap);
    CHECK(caps.wanted_sq(cell, cap, {0.5}) == Approx(50.0 * 50.0).epsilon(1e-4));
    cell.feed_mm_s = 40.0;
    CHECK(caps.wanted_sq(cell, cap, {1.0}) == Approx(40.0 * 40.0).epsilon(1e-4));
    CHECK(caps.wanted_sq(cell, cap, {2.0}) == Approx(80.0 * 80.0).epsilon(1e-4));
    CHECK(caps.wanted_sq(cell, 9.0, {2.0}) == 9.0);
    CHECK(caps.wanted_sq(cell, cap, {2.0, 50.0}) == Approx(50.0 * 50.0).epsilon(1e-4));
    CHECK(caps.wanted_sq(cell, cap, {1.0, 50.0}) == Approx(40.0 * 40.0).epsilon(1e-4));
    cell.feed_mm_s = rapid_feed<double>; // follows its own override alone
    CHECK(caps.wanted_sq(cell, cap, {.ratio = 0.5}) == cap);
    CHECK(caps.wanted_sq(cell, cap, {.ratio = 2.0, .rapids = 0.5}) == Approx(0.25 * cap).epsilon(1e-12));
    CHECK(caps.wanted_sq(cell, cap, {.most_mm_s = 50.0}) == Approx(50.0 * 50.0).epsilon(1e-4));
    // A turn of its own, which a feed and its override do not reach
    MachineSettings machine = two_axes();
    machine.axis[1].rotary = true;
    machine.axis[1].max_velocity_mm_s = 360.0;
    machine.max_turning_deg_s = 4.0 * machine.max_feed_mm_s;
    const auto turning = MotionLimits<double>::make(machine).value();
    Cell<double> turn = cell_along(0.0, 1.0);
    const double rapid = SpeedCaps<double>(turning).cap(turn).least_sq();
    turn.feed_mm_s = 90.0;
    CHECK(SpeedCaps<double>(turning).cap(turn).least_sq() == Approx(100.0 * 100.0).epsilon(1e-4));
    CHECK(rapid > 1.5 * 100.0 * 100.0);
    // Even an override of 0 leaves a speed that a cell can be passed with: the hold is what stops.
    CHECK(caps.wanted_sq(cell, cap, {0.0}) > 0.0);
}
