// SPDX-License-Identifier: MIT
//
// Straight moves from rest to rest, whose least time is known in closed form: the trapezoid.
#include "support/catch.hpp"
#include "support/pipeline.hpp"

using namespace splinefeed_test;

namespace {

double trapezoid_seconds(double length, double feed, double acceleration) {
    return length >= feed * feed / acceleration ? length / feed + feed / acceleration
                                                : 2.0 * std::sqrt(length / acceleration);
}

} // namespace

TEMPLATE_TEST_CASE("straight moves take the time of the trapezoid", "[feed_plan]", double, Fixed) {
    for (const double acceleration : {1.0, 30.0, 1000.0, 1e5}) {
        for (const double feed : {0.01, 0.5, 10.0, 100.0, 1000.0}) {
            for (const double length : {0.001, 0.02, 1.0, 30.0, 1000.0}) {
                if (length / feed > 1e5) {
                    continue;
                }
                const MachineSettings machine = machine_of(1, 2000.0, acceleration, feed);
                const auto planned = plan_of<TestType>({line_shape(1, 3, {length})}, machine, 1U << 15);
                const double seconds = planned.seconds();
                const double least = trapezoid_seconds(length, feed, acceleration);
                CAPTURE(scalar_name<TestType>(), acceleration, feed, length, seconds, least);
                CHECK(seconds < least * 1.005);
                CHECK(seconds > least * (1.0 - 1e-6));
            }
        }
    }
}

TEST_CASE("straight moves in float take little longer", "[feed_plan]") {
    // A thousandth of every limit is kept, and cells near the stops are as short as 24 bits allow, not shorter
    for (const double acceleration : {300.0, 1000.0, 1e4}) {
        for (const double feed : {10.0, 100.0}) {
            for (const double length : {1.0, 10.0, 30.0}) {
                const MachineSettings machine = machine_of(1, 2000.0, acceleration, feed);
                const auto planned = plan_of<float>({line_shape(1, 3, {length})}, machine, 1U << 13);
                CAPTURE(acceleration, feed, length);
                CHECK(planned.seconds() < trapezoid_seconds(length, feed, acceleration) * 1.02);
                CHECK(planned.seconds() > trapezoid_seconds(length, feed, acceleration));
            }
        }
    }
}

TEST_CASE("an axis that hardly moves limits nothing and overflows nothing", "[feed_plan]") {
    for (const double drift : {1e-3, 1e-6, 1e-9, 1e-12}) {
        const MachineSettings machine = machine_of(2, 100.0, 1000.0, 100.0);
        const auto planned = plan_of<Fixed>({line_shape(2, 3, {100.0, drift})}, machine, 1024);
        CHECK(planned.seconds() == Approx(trapezoid_seconds(100.0, 100.0, 1000.0)).epsilon(0.005));
    }
}

TEMPLATE_TEST_CASE("oblique moves are limited by the axis that is used up first", "[feed_plan]", double, Fixed) {
    MachineSettings machine = machine_of(3, 1000.0, 1000.0, 1000.0);
    machine.axis[1].max_velocity_mm_s = 30.0;
    machine.axis[2].max_acceleration_mm_s2 = 100.0;
    // Direction (3, 4, 12) / 13: the second axis reaches 30 mm/s at 97.5, the third 100 mm/s2 at 108.33
    const auto planned = plan_of<TestType>({line_shape(3, 3, {300.0, 400.0, 1200.0})}, machine, 1U << 14);
    CHECK(planned.seconds() == Approx(trapezoid_seconds(1300.0, 97.5, 1300.0 / 12.0)).epsilon(0.005));
}

TEMPLATE_TEST_CASE("programmed feeds change where the segments meet", "[feed_plan]", double, Fixed) {
    const MachineSettings machine = machine_of(1, 1000.0, 1000.0, 200.0);
    BezierPath path{line_shape(1, 3, {100.0}), line_shape(1, 3, {100.0}), line_shape(1, 3, {100.0})};
    path[0].feed_mm_s = 50.0;
    path[1].feed_mm_s = 500.0; // above the machine's
    path[2].feed_mm_s = 20.0;
    const auto planned = plan_of<TestType>(path, machine, 1U << 14);
    double at = 0.0;
    double fastest = 0.0;
    for (const auto& c : planned.cells) {
        at += to_double(c.cell.length_mm);
        fastest = std::max(fastest, to_double(c.exit_sq));
        if (std::fabs(at - 100.0) < 1e-6) {
            CHECK(std::sqrt(to_double(c.exit_sq)) == Approx(50.0).epsilon(1e-5));
        }
        if (std::fabs(at - 200.0) < 1e-6) {
            CHECK(std::sqrt(to_double(c.exit_sq)) == Approx(20.0).epsilon(1e-5));
        }
    }
    CHECK(std::sqrt(fastest) == Approx(200.0).epsilon(1e-5));
    // 50 from rest; up to 200 and down to 20; 20 to rest
    const double up = (40000.0 - 2500.0) / 2000.0;
    const double down = (40000.0 - 400.0) / 2000.0;
    const double seconds =
        (100.0 - 1.25) / 50.0 + 0.05 + 0.15 + (100.0 - up - down) / 200.0 + 0.18 + (100.0 - 0.2) / 20.0 + 0.02;
    CHECK(planned.seconds() == Approx(seconds).epsilon(0.005));
}

TEMPLATE_TEST_CASE("a block's maximum holds with and without a feed of its own", "[feed_plan]", double, Fixed) {
    MachineSettings machine = machine_of(1, 1000.0, 1000.0, 200.0);
    const auto seconds = [&](double feed, double most) {
        BezierPath path{line_shape(1, 3, {100.0})};
        path[0].feed_mm_s = feed;
        path[0].max_feed_mm_s = most;
        return plan_of<TestType>(path, machine, 1U << 14).seconds();
    };
    CHECK(seconds(0.0, 50.0) == Approx(trapezoid_seconds(100.0, 50.0, 1000.0)).epsilon(0.005));
    CHECK(seconds(80.0, 50.0) == Approx(trapezoid_seconds(100.0, 50.0, 1000.0)).epsilon(0.005));
    CHECK(seconds(30.0, 50.0) == Approx(trapezoid_seconds(100.0, 30.0, 1000.0)).epsilon(0.005));
    CHECK(seconds(0.0, 500.0) == Approx(trapezoid_seconds(100.0, 200.0, 1000.0)).epsilon(0.005));
    // The move before it is not held down
    BezierPath path{line_shape(1, 3, {100.0}), line_shape(1, 3, {100.0})};
    path[1].max_feed_mm_s = 20.0;
    const double down = (40000.0 - 400.0) / 2000.0;
    CHECK(plan_of<TestType>(path, machine, 1U << 14).seconds() ==
          Approx(0.2 + (80.0 - down) / 200.0 + 0.18 + 99.8 / 20.0 + 0.02).epsilon(0.005));
}

TEMPLATE_TEST_CASE("a circle runs at the speed that its curvature allows", "[feed_plan]", double, Fixed) {
    // A quarter circle of 10 mm as a cubic: its radius is right within 3e-4, its curvature within 1 %
    const double h = 10.0 * 0.5522847498;
    const auto speeds = [&](const MachineSettings& machine) {
        BezierPath path;
        for (int i = 0; i < 4; ++i) {
            const double c = i % 2 == 0 ? 1.0 - i : 0.0;
            const double s = i % 2 == 1 ? 2.0 - i : 0.0;
            TestShape quarter = cubic_shape(h, 0.0, 10.0, 10.0 - h, 10.0, 10.0);
            for (unsigned j = 0; j < 4; ++j) {
                const double x = quarter.offset[0][j];
                const double y = quarter.offset[1][j];
                quarter.offset[0][j] = c * x - s * y;
                quarter.offset[1][j] = s * x + c * y;
            }
            path.push_back(quarter);
        }
        double b = 0.0;
        double slowest = 1e9;
        const auto planned = plan_of<TestType>(path, machine, 1U << 13);
        for (const auto& c : planned.cells) {
            b = std::max(b, to_double(c.exit_sq));
            if (c.cell.waypoint == 1) {
                slowest = std::min(slowest, to_double(c.exit_sq));
            }
        }
        CHECK(slowest > 0.85 * b);
        return std::array<double, 2>{std::sqrt(slowest), std::sqrt(b)};
    };
    MachineSettings machine = machine_of(2, 1000.0, 1e5, 1000.0);
    machine.centripetal_mm_s2 = 1000.0;
    for (const double speed : speeds(machine)) {
        CHECK(speed == Approx(100.0).epsilon(0.02));
    }
    machine.centripetal_mm_s2 = 0.0;
    machine.chord_error_mm = 1e-4; // 8 e rho / T^2
    for (const double speed : speeds(machine)) {
        CHECK(speed == Approx(std::sqrt(8.0 * 1e-4 * 10.0) / 1e-3).epsilon(0.02));
    }
    machine.chord_error_mm = 0.0;
    machine = machine_of(2, 1000.0, 1000.0, 1000.0);
    // One axis takes all of the centripetal acceleration where the circle runs along the other; on the diagonals both
    // share it, and there the speed may reach 2^(1/4) times as much.
    const auto [slow, fast] = speeds(machine);
    CHECK(slow == Approx(100.0).epsilon(0.02));
    CHECK(fast > 100.0);
    CHECK(fast < 119.0);
}
