// SPDX-License-Identifier: MIT
#include "host_sim/drive/axis_moves.hpp"
#include "support/catch.hpp"

#include <array>

using namespace splinefeed::host;

namespace {

std::array<PvtAxisParameters, 2> two_axes() {
    std::array<PvtAxisParameters, 2> axes{};
    axes[0].stop_counts_s2 = 1000.0;
    axes[1].stop_counts_s2 = 500.0;
    axes[0].homing_counts_s = axes[1].homing_counts_s = 100.0;
    axes[0].homing_counts_s2 = 1000.0;
    axes[1].homing_counts_s2 = 200.0;
    return axes;
}

} // namespace

TEST_CASE("axis moves: each axis stops as hard as it can, and all are done with the last", "[drive][axis_moves]") {
    const auto axes = two_axes();
    PvtReference reference{.counts = {10.0, 20.0}, .counts_s = {100.0, -200.0}};
    AxisMoves moves;
    moves.stop(reference, axes);
    CHECK_FALSE(moves.pass(0.05, reference));
    CHECK(reference.counts[0] == Approx(10.0 + 0.05 * (100.0 + 50.0) / 2));
    CHECK(reference.counts_s[0] == Approx(50.0));
    CHECK(reference.counts_s[1] == Approx(-175.0));
    CHECK_FALSE(moves.pass(0.1, reference)); // the first one stands since 0.1 s, the second will at 0.4 s
    CHECK(reference.counts[0] == Approx(15.0));
    CHECK(reference.counts_s[0] == 0.0);
    CHECK(reference.counts_s[1] == Approx(-125.0));
    CHECK(moves.pass(0.3, reference));
    CHECK(reference.counts[1] == Approx(20.0 - 40.0));
    CHECK(reference.rests());
    CHECK(reference.counts[2] == 0.0);
}

TEST_CASE("axis moves: each axis goes home at its own speed, exactly to 0", "[drive][axis_moves]") {
    const auto axes = two_axes();
    PvtReference reference{.counts = {50.0, -50.0}, .counts_s = {}};
    AxisMoves moves;
    moves.home(reference, axes);
    CHECK_FALSE(moves.pass(0.3, reference));
    CHECK(reference.counts[0] == Approx(50.0 - 100.0 * 0.25)); // half of the ramp of 0.1 s is lost
    CHECK(reference.counts_s[0] == Approx(-100.0));
    CHECK(reference.counts[1] == Approx(-50.0 + 0.5 * 200.0 * 0.09));
    CHECK_FALSE(moves.pass(0.31, reference)); // 0.6 s, and 2 sqrt(50 / 200) s = 1 s
    CHECK(reference.counts[0] == 0.0);
    CHECK(reference.counts_s[0] == 0.0);
    CHECK(moves.pass(0.4, reference));
    CHECK(reference.counts[1] == 0.0);
    CHECK(reference.rests());
}

TEST_CASE("axis moves: a stop in the middle of homing begins anew", "[drive][axis_moves]") {
    const auto axes = two_axes();
    PvtReference reference{.counts = {50.0, 0.0}, .counts_s = {}};
    AxisMoves moves;
    moves.home(reference, axes);
    CHECK_FALSE(moves.pass(0.3, reference));
    moves.stop(reference, axes);
    CHECK_FALSE(moves.pass(0.05, reference));
    CHECK(reference.counts_s[0] == Approx(-50.0));
    CHECK(moves.pass(0.06, reference));
    CHECK(reference.counts[0] == Approx(25.0 - 5.0));
}
