// SPDX-License-Identifier: MIT
//
// A tolerance never costs time: within it a program is not slower than with a stop at the end of every move. What is
// emitted is compared.
#include "emitted_moves.hpp"
#include "support/random_moves.hpp"
#include "support/rounds.hpp"

using namespace splinefeed_test;

namespace {

constexpr std::uint64_t seed = 20261127;

} // namespace

TEST_CASE("a tolerance makes no program slower than exact stops", "[never_slower]") {
    for (int round = static_cast<int>(first_round()), count = rounds(60, 3000); round < count; ++round) {
        Random random(seed + static_cast<std::uint64_t>(round));
        const MoveProgram program = random_moves(random, 200.0L);
        MachineSettings machine = machine_of(program.axes, 100.0, 1000.0, 100.0, random.chance(0.5) ? 1000 : 250);
        if (random.chance(0.3)) {
            machine.centripetal_mm_s2 = random.decades(10.0, 1e4);
        }
        CAPTURE(round, program.moves.size(), machine.centripetal_mm_s2, machine.sample_period_us);
        const EmittedMoves within = emit<double>(program, machine, false);
        const EmittedMoves stops = emit<double>(program, machine, true);
        require_limits(within, machine);
        const double least = static_cast<double>(stops.segments.size());
        CHECK(static_cast<double>(within.segments.size()) <= 1.001 * least + 2.0);
    }
}

TEST_CASE("corners are stops where a limit across the path makes their blend slower", "[never_slower]") {
    MachineSettings machine = machine_of(2, 100.0, 1000.0, 100.0);
    CHECK(sharpest_blend(machine).curvature_1_mm == 0.0);
    machine.centripetal_mm_s2 = 2000.0;
    CHECK(sharpest_blend(machine).curvature_1_mm == 0.0);
    machine.centripetal_mm_s2 = 100.0;
    CHECK(sharpest_blend(machine).curvature_1_mm == Approx(100.0 / 2500.0));
    CHECK(sharpest_blend(machine).half_sine == Approx(0.15));
    machine.centripetal_mm_s2 = 0.0;
    machine.chord_error_mm = 1e-5; // 8 e / T^2 = 80 mm/s^2
    CHECK(sharpest_blend(machine).half_sine == Approx(0.12));
    machine.chord_error_mm = 0.0;
    machine.centripetal_mm_s2 = 100.0;
    MoveProgram corners;
    corners.axes = 2;
    for (int i = 1; i <= 10; ++i) {
        corners.line({static_cast<Real>(5 * ((i + 1) / 2)), static_cast<Real>(5 * (i / 2))}).tolerance_mm = 0.05;
    }
    const EmittedMoves within = emit<double>(corners, machine, false);
    const EmittedMoves stops = emit<double>(corners, machine, true);
    require_limits(within, machine);
    CHECK(within.segments.size() == stops.segments.size());
}

TEMPLATE_TEST_CASE("what is no joint to a path is none to its plan", "[blended_path][limits]", double, Fixed) {
    int made = 0;
    for (std::uint64_t round = 0; round < 2000; ++round) {
        Random random(7000 + round);
        MachineSettings machine;
        machine.axes = random.integer(1, max_axes);
        machine.sample_period_us = random.integer(50, 4000);
        machine.max_feed_mm_s = random.decades(1.0, 5000.0);
        for (AxisSettings& axis : machine.axis) {
            axis.max_velocity_mm_s = random.decades(1.0, 5000.0);
            axis.max_acceleration_mm_s2 = random.decades(10.0, 1e6); // also one that the jerk lets nobody reach
            axis.max_jerk_mm_s3 = random.chance(0.8) ? random.decades(1e3, 1e8) : 0.0;
            axis.rotary = random.chance(0.2);
        }
        const auto limits = MotionLimits<TestType>::make(machine, SampledIn::float64);
        if (!limits.has_value()) {
            continue; // its numbers do not go together
        }
        ++made;
        CAPTURE(round);
        const SmoothJoint<double> smooth = path_rules(machine).smooth;
        REQUIRE(smooth.jump <= to_double(limits->refinement.direction_jump));
        const double fastest = to_double(limits->path_mm_s);
        const double jerk =
            detail::jump_in_jerk * smooth.bend_1_mm * fastest * fastest * to_double(limits->segments_per_s);
        for (const unsigned k : indices(machine.axes)) {
            REQUIRE((!limits->jerk_limited || jerk <= detail::jerk_reserve * to_double(limits->jerk_mm_s3[k])));
        }
    }
    CHECK(made > 1000);
}
