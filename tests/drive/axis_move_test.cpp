// SPDX-License-Identifier: MIT
#include "host_sim/drive/axis_moves.hpp"
#include "support/catch.hpp"

#include <cmath>

using namespace splinefeed::host;

namespace {

void check_steps(const AxisMove& move, double velocity, double acceleration) {
    const int steps = 2000;
    const double h = move.duration_s() / steps;
    for (int i = 0; i < steps; ++i) {
        const AxisMove::State a = move.at(h * i);
        const AxisMove::State b = move.at(h * (i + 1));
        REQUIRE(std::fabs(a.velocity) <= velocity * (1.0 + 1e-9));
        REQUIRE(std::fabs(b.velocity - a.velocity) <= acceleration * h * (1.0 + 1e-6) + 1e-9);
        REQUIRE(b.position - a.position == Approx(0.5 * (a.velocity + b.velocity) * h).margin(acceleration * h * h));
    }
}

} // namespace

TEST_CASE("axis move: a stop brakes at its deceleration and ends where v^2 / 2a says", "[drive][axis_move]") {
    for (const double velocity : {0.0, 500.0, -500.0}) {
        const AxisMove stop = AxisMove::stop({10.0, velocity}, 1000.0);
        CHECK(stop.duration_s() == Approx(std::fabs(velocity) / 1000.0));
        CHECK(stop.at(0.0).velocity == velocity);
        const double end = 10.0 + velocity * std::fabs(velocity) / 2000.0;
        CHECK(stop.at(stop.duration_s() + 1.0).position == Approx(end));
        CHECK(stop.at(stop.duration_s() + 1.0).velocity == 0.0);
    }
}

TEST_CASE("axis move: from rest to rest within velocity and acceleration, there exactly", "[drive][axis_move]") {
    for (const double target : {1000.0, -1000.0, 3.0, 0.1, 77.0}) {
        CAPTURE(target);
        const AxisMove move = AxisMove::to(0.1, target, 200.0, 900.0);
        check_steps(move, 200.0, 900.0);
        CHECK(move.at(move.duration_s() * 1.001).position == target);
        CHECK(move.at(move.duration_s() * 0.999999).position == Approx(target).margin(1e-3));
    }
    CHECK(AxisMove::to(5.0, 5.0, 200.0, 900.0).duration_s() == 0.0);
}
