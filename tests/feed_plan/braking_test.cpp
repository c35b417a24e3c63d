// SPDX-License-Identifier: MIT
//
// Axes that brake with another limit than they accelerate with.
#include "support/catch.hpp"
#include "support/emitted.hpp"
#include "support/plan_reference.hpp"
#include "support/rounds.hpp"

using namespace splinefeed_test;

namespace {

constexpr std::uint64_t seed = 61;

} // namespace

TEMPLATE_TEST_CASE("rest to rest with a ramp for each limit", "[feed_plan][braking]", double, Fixed) {
    for (const double speeding : {100.0, 1000.0, 5000.0}) {
        for (const double braking : {100.0, 400.0, 1000.0, 20000.0}) {
            for (const double length : {0.05, 1.0, 30.0, -30.0, 400.0}) {
                MachineSettings machine = machine_of(1, 2000.0, speeding, 2000.0);
                machine.axis[0].max_braking_mm_s2 = braking;
                const auto planned = plan_of<TestType>({line_shape(1, 3, {length})}, machine, 1U << 14);
                const double least = std::sqrt(2.0 * std::fabs(length) * (1.0 / speeding + 1.0 / braking));
                CAPTURE(speeding, braking, length, planned.seconds(), least);
                // Eight cells at least: the peak may lie within one, where the plan keeps one acceleration
                const double ratio = std::max(speeding, braking) / std::min(speeding, braking);
                CHECK(planned.seconds() < least * (ratio < 5.0 ? 1.005 : 1.07));
                CHECK(planned.seconds() > least * (1.0 - 1e-6));
                const Use use = use_of(planned.cells, machine);
                CHECK(use.acceleration <= 1.0L);
            }
        }
    }
}

TEMPLATE_TEST_CASE("ramps to and from the feed have a limit each", "[feed_plan][braking]", double, Fixed) {
    MachineSettings machine = machine_of(2, 2000.0, 1000.0, 100.0);
    machine.axis[0].max_braking_mm_s2 = 250.0;
    // The second axis, slower by half, may brake with as much as the first has to
    machine.axis[1].max_braking_mm_s2 = 125.0;
    const auto planned = plan_of<TestType>({line_shape(2, 3, {80.0, 40.0})}, machine, 1U << 14);
    const double slant = std::sqrt(5.0) / 2.0; // mm of path per mm of the first axis
    const double up = 100.0 / (1000.0 * slant);
    const double down = 100.0 / (250.0 * slant);
    const double seconds = 80.0 * slant / 100.0 + 0.5 * (up + down);
    CHECK(planned.seconds() == Approx(seconds).epsilon(0.005));
    CHECK(use_of(planned.cells, machine).acceleration <= 1.0L);
}

TEMPLATE_TEST_CASE("every limit holds and no node can be faster, braking apart", "[feed_plan][braking]", double, float,
                   Fixed) {
    CHECK(require_best_plans<TestType>(seed, rounds(10), brake_differently).acceleration > 0.98L);
}

TEMPLATE_TEST_CASE("what is emitted brakes within its limit, axes that turn round included", "[feed_plan][braking]",
                   double, Fixed) {
    Real most = 0.0L;
    const auto judge = [&](const Stream& stream, const MachineSettings& machine) {
        most = std::max(most, require_limits(stream, machine).acceleration);
    };
    for (const double braking : {150.0, 400.0, 4000.0}) {
        for (const int period : {250, 1000, 4000}) {
            MachineSettings machine = machine_of(3, 100.0, 1000.0, 100.0, period);
            for (AxisSettings& axis : machine.axis) {
                axis.max_braking_mm_s2 = braking;
            }
            CAPTURE(braking, period);
            judge(stream_of<TestType>(loop_program(), machine), machine);
            judge(stream_of<TestType>(circle_program(36), machine), machine);
            judge(stream_of<TestType>(raster_program(), machine), machine);
            judge(stream_of<TestType>(star_program(true), machine), machine);
        }
    }
    Random random(seed + 2);
    for (int run = 0; run < rounds(12); ++run) {
        const int axes = random.integer(1, max_axes);
        MachineSettings machine = random_machine(random, axes);
        brake_differently(random, machine);
        const Program program = random_program(random, axes);
        if (MotionLimits<TestType>::make(machine).has_value()) {
            CAPTURE(seed, run);
            judge(stream_of<TestType>(program, machine, random.chance(0.5) ? 16 : 512), machine);
        }
    }
    CHECK(most > 0.99L);
}

TEMPLATE_TEST_CASE("where the curvature jumps an axis may turn round at once", "[feed_plan][braking]", double, Fixed) {
    Random random(seed + 3);
    for (int run = 0; run < rounds(12); ++run) {
        const int axes = random.integer(2, max_axes);
        MachineSettings machine = random_machine(random, axes);
        brake_differently(random, machine);
        const BezierPath path = random_path(random, axes, 6, random.decades(0.05, 50.0), 0.3, 0.3);
        CAPTURE(seed, run);
        require_limits(stream_of<TestType>(path, machine, 256), machine);
    }
}
