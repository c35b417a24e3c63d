// SPDX-License-Identifier: MIT
//
// Random machines with jerk limits on random paths: whatever the limits, what is emitted keeps them at every instant,
// and ends exactly.
#include "support/catch.hpp"
#include "support/rounds.hpp"
#include "support/stream_reference.hpp"

using namespace splinefeed_test;

namespace {

/// Jerk limits over four decades of the time that the acceleration takes to rise.
MachineSettings jerk_limited_machine(Random& random, int axes) {
    MachineSettings machine = random_machine(random, axes);
    machine.jerk_tier = random.chance(0.5) ? JerkTier::bounded : JerkTier::optimal;
    for (AxisSettings& axis : machine.axis) {
        if (random.chance(0.9)) {
            axis.max_jerk_mm_s3 = std::min(axis.max_acceleration_mm_s2 / random.decades(1e-4, 1.0), 1e9);
        }
    }
    return machine;
}

template <class S>
void require_limits(const Stream& stream, const MachineSettings& machine, Used& worst) {
    REQUIRE_FALSE(stream.endless);
    Used used;
    REQUIRE(std::string(check_stream(stream.segments, machine, used)).empty());
    CAPTURE(static_cast<double>(used.jerk), static_cast<double>(used.acceleration));
    CHECK(used.jerk <= 1.0L);
    CHECK(used.acceleration <= 1.0L);
    CHECK(used.velocity <= 1.0L);
    CHECK(used.feed <= 1.0L);
    worst.jerk = std::max(worst.jerk, used.jerk);
    worst.acceleration = std::max(worst.acceleration, used.acceleration);
}

} // namespace

TEMPLATE_TEST_CASE("jerk-limited machines, splines and polylines", "[stream][jerk]", double, Fixed) {
    using S = TestType;
    Used worst;
    int runs = 0;
    int slow = 0;
    const std::uint64_t first = 5000;
    for (std::uint64_t seed = first; seed < first + static_cast<std::uint64_t>(rounds(40)); ++seed) {
        Random random(seed);
        const int axes = random.integer(1, max_axes);
        const MachineSettings machine = jerk_limited_machine(random, axes);
        const Program program = random_program(random, axes);
        if (!MotionLimits<S>::make(machine).has_value()) {
            continue;
        }
        CAPTURE(seed, scalar_name<S>());
        const Stream stream = stream_of<S>(program, machine, random.chance(0.5) ? 32 : 256);
        require_limits<S>(stream, machine, worst);
        for (unsigned k = 0; k < static_cast<unsigned>(program.axes); ++k) {
            REQUIRE(stream.segments.front().start[k] == target_units(program.points.front().mm[k], machine.axis[k]));
            REQUIRE(stream.segments.back().end[k] == target_units(program.points.back().mm[k], machine.axis[k]));
        }
        ++runs;
        slow += stream.slow_legs > 0 ? 1 : 0;
    }
    CHECK(worst.jerk > 0.9L); // the machines were used
    CHECK(2 * runs > rounds(40));
    CHECK(slow * 10 <= runs);
}

TEMPLATE_TEST_CASE("jerk-limited machines and Bezier segments", "[stream][jerk]", double, Fixed) {
    using S = TestType;
    Used worst;
    int runs = 0;
    int slow = 0;
    const std::uint64_t first = 6000;
    for (std::uint64_t seed = first; seed < first + static_cast<std::uint64_t>(rounds(25)); ++seed) {
        Random random(seed);
        const int axes = random.integer(2, max_axes);
        const MachineSettings machine = jerk_limited_machine(random, axes);
        const BezierPath path = random_path(random, axes, 6, random.decades(0.05, 50.0), 0.3, 0.3);
        if (!MotionLimits<S>::make(machine).has_value()) {
            continue;
        }
        CAPTURE(seed, scalar_name<S>());
        // Soft axes on long paths: minutes of the machine's time
        const auto limits = MotionLimits<double>::make(machine).value();
        if (plan_of<double>(path, machine, 512).seconds() * limits.segments_per_s > 1e5) {
            continue;
        }
        const Stream stream = stream_of<S>(path, machine, 256);
        require_limits<S>(stream, machine, worst);
        ++runs;
        slow += stream.slow_legs > 0 ? 1 : 0;
    }
    CHECK(worst.jerk > 0.9L);
    CHECK(2 * runs > rounds(25));
    CHECK(slow * 10 <= runs);
}

TEST_CASE("a straight move takes the time of the S-curve", "[stream][jerk]") {
    for (const JerkTier tier : {JerkTier::bounded, JerkTier::optimal}) {
        for (const double length : {0.1, 1.0, 10.0, 100.0}) {
            for (const double jerk : {1e4, 3e4, 1e5}) {
                MachineSettings machine = machine_of(2, 100.0, 1000.0, 100.0);
                machine.jerk_tier = tier;
                machine.axis[0].max_jerk_mm_s3 = machine.axis[1].max_jerk_mm_s3 = jerk;
                BezierPath path{cubic_shape(length / 3.0, 0.0, length / 1.5, 0.0, length, 0.0)};
                const Stream stream = stream_of<double>(path, machine, 256);
                const double segment_s = stream.segments[0].duration_ticks / 8e6;
                const double seconds = static_cast<double>(stream.segments.size()) * segment_s;
                const double least = StraightMove(length, {100.0, 1000.0, jerk}).duration_s();
                CAPTURE(length, jerk, seconds, least);
                CHECK(seconds <= 1.001 * least + 3.0 * segment_s); // the dwell at the end
                CHECK(seconds >= least);
            }
        }
    }
}
