// SPDX-License-Identifier: MIT
#include "host_sim/analysis/exact_stop_time.hpp"

#include "support/catch.hpp"

#include <cmath>
#include <numbers>

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

/// The same by integration: the acceleration of half a move, symmetrical in its middle.
double integrated_s(double length, double speed, double acceleration, double jerk) {
    const auto reached = [&](double v, double& way) {
        const double ramp = v > acceleration * acceleration / jerk ? acceleration / jerk : std::sqrt(v / jerk);
        const double hold = (v - jerk * ramp * ramp) / (jerk * ramp);
        const double seconds = 2.0 * ramp + hold;
        constexpr int steps = 20000;
        way = 0.0;
        double now = 0.0;
        for (int i = 0; i < steps; ++i) {
            const double t = (i + 0.5) * seconds / steps;
            const double a = jerk * std::fmin(std::fmin(t, seconds - t), ramp);
            way += (now + 0.5 * a * seconds / steps) * seconds / steps;
            now += a * seconds / steps;
        }
        return seconds;
    };
    double way = 0.0;
    if (const double seconds = reached(speed, way); 2.0 * way <= length) {
        return 2.0 * seconds + (length - 2.0 * way) / speed;
    }
    double low = 0.0;
    double high = speed;
    double seconds = 0.0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        seconds = reached(middle, way);
        (2.0 * way < length ? low : high) = middle;
    }
    return 2.0 * seconds;
}

} // namespace

TEST_CASE("a move from rest to rest takes what its integration says") {
    for (const double length : {1e-4, 0.01, 0.3, 1.0, 5.0, 40.0, 500.0}) {
        CAPTURE(length);
        CHECK(rest_to_rest_s(length, 100.0, 1000.0, 30000.0) ==
              Approx(integrated_s(length, 100.0, 1000.0, 30000.0)).epsilon(1e-4));
        CHECK(rest_to_rest_s(length, 10.0, 1000.0, 30000.0) ==
              Approx(integrated_s(length, 10.0, 1000.0, 30000.0)).epsilon(1e-4));
    }
    CHECK(rest_to_rest_s(100.0, 100.0, 1000.0, 0.0) == Approx(1.1));
    CHECK(rest_to_rest_s(2.5, 100.0, 1000.0, 0.0) == Approx(0.1));
    CHECK(rest_to_rest_s(0.0, 100.0, 1000.0, 0.0) == 0.0);
}

TEST_CASE("a program with exact stops is the sum of its moves") {
    MachineSettings machine;
    machine.axes = 2;
    machine.max_feed_mm_s = 100.0;
    ExactStopTime time(machine);
    time.start({});
    PathElement<double> move;
    move.to = {position_from_mm(100.0)};
    time.move(move);
    CHECK(time.seconds() == Approx(1.1));
    move.to = {position_from_mm(200.0), position_from_mm(100.0)}; // at the feed, with more acceleration
    time.move(move);
    CHECK(time.seconds() == Approx(1.1 + std::sqrt(2.0) + 0.1 / std::sqrt(2.0)));
    move.feed_mm_s = 50.0;
    move.to = {position_from_mm(200.0)};
    time.move(move);
    const double before = time.seconds();
    PathElement<double> arc;
    arc.shape = MoveShape::arc;
    arc.to = {position_from_mm(200.0)};
    arc.arc.centre = {position_from_mm(190.0)};
    arc.arc.normal = {0.0, 0.0, 1.0};
    arc.arc.sweep_rad = 2.0 * std::numbers::pi;
    time.move(arc);
    const double a = 1000.0 / std::sqrt(2.0);
    CHECK(time.seconds() - before ==
          Approx(rest_to_rest_s(20.0 * std::numbers::pi, std::sqrt(a * 10.0), a, 0.0)).epsilon(0.01));
}

TEST_CASE("An arc of many turns is as long as they are, and no sharper than one") {
    MachineSettings machine;
    machine.axes = 4;
    machine.max_feed_mm_s = 100.0;
    machine.axis[3].rotary = true;
    const double a = 1000.0 / std::sqrt(2.0);
    for (const double turns : {0.5, 1.0, 7.25, 300.0}) {
        for (const double rise : {0.0, 40.0}) {
            for (const double growth : {0.0, 5.0}) {
                ExactStopTime time(machine);
                time.start({position_from_mm(10.0)});
                PathElement<double> arc;
                arc.shape = MoveShape::arc;
                const double sweep = 2.0 * std::numbers::pi * turns;
                const double radius = 10.0 + growth;
                arc.to = {position_from_mm(radius * std::cos(sweep)), position_from_mm(radius * std::sin(sweep)),
                          position_from_mm(rise)};
                arc.arc.normal = {0.0, 0.0, 1.0};
                arc.arc.sweep_rad = sweep;
                time.move(arc);
                double length = 0.0;
                const int steps = static_cast<int>(1000.0 * turns);
                for (int i = 0; i < steps; ++i) {
                    const double middle = 10.0 + growth * (i + 0.5) / steps;
                    length += std::hypot(middle * sweep, growth, rise) / steps;
                }
                CAPTURE(turns, rise, growth);
                // The radius of a helix is larger than that of its circle.
                const double slope = rise / sweep;
                const double least = 10.0 + slope * slope / 10.0;
                const double speed = std::fmin(100.0, std::sqrt(a * least));
                CHECK(time.seconds() ==
                      Approx(rest_to_rest_s(length, speed, a, 0.0)).epsilon(growth > 0.0 ? 0.02 : 1e-6));
            }
        }
    }
}

TEST_CASE("A move of rotary axes alone has its programmed feed, and no more than the move allows") {
    MachineSettings machine;
    machine.axes = 4;
    machine.max_feed_mm_s = 50.0;
    machine.axis[3].rotary = true;
    machine.axis[3].max_velocity_mm_s = 360.0;
    const auto seconds = [&](double feed, double most, double x) {
        ExactStopTime time(machine);
        time.start({});
        PathElement<double> move;
        move.to = {position_from_mm(x), {}, {}, position_from_mm(90.0)};
        move.feed_mm_s = feed;
        move.max_feed_mm_s = most;
        time.move(move);
        return time.seconds();
    };
    const double a = machine.axis[3].smaller_acceleration_mm_s2();
    CHECK(seconds(10.0, 0.0, 0.0) == Approx(rest_to_rest_s(90.0, 10.0, a, 0.0)));
    CHECK(seconds(100.0, 30.0, 0.0) == Approx(rest_to_rest_s(90.0, 30.0, a, 0.0)));
    CHECK(seconds(0.0, 0.0, 0.0) == Approx(rest_to_rest_s(90.0, 360.0, a, 0.0))); // a rapid
    CHECK(seconds(10.0, 0.0, 10.0) < 1.2);                                        // x counts
}
