// SPDX-License-Identifier: MIT
//
// Random machines with jerk limits on random paths: whatever the limits, what is emitted keeps them at every instant,
// and ends exactly.
#include "support/catch.hpp"
#include "support/emitted.hpp"
#include "support/random_steering.hpp"
#include "support/rounds.hpp"

#include <cmath>
#include <optional>

using namespace splinefeed_test;

namespace {

/// @param travel  runs a machine along something random, or does not where that is beyond it
template <class Travel>
void require_random_machines(std::uint64_t first, int rounds, int fewest_axes, Travel&& travel) {
    Real most = 0.0L;
    int runs = 0;
    int slow = 0;
    for (std::uint64_t seed = first; seed < first + static_cast<std::uint64_t>(rounds); ++seed) {
        Random random(seed);
        MachineSettings machine = random_machine(random, random.integer(fewest_axes, max_axes));
        limit_jerk(random, machine);
        CAPTURE(seed);
        if (const std::optional<Stream> stream = travel(random, machine)) {
            most = std::max(most, require_limits(*stream, machine).jerk);
            ++runs;
            slow += stream->slow_legs > 0 ? 1 : 0;
        }
    }
    CHECK(most > 0.9L); // the machines were used
    CHECK(2 * runs > rounds);
    CHECK(slow <= 1 + runs / 5); // most of them in windows of 32 cells
}

} // namespace

TEMPLATE_TEST_CASE("jerk-limited machines, splines and polylines", "[stream][jerk]", DoubleInDouble, FixedInDouble,
                   FixedInFloat) {
    using S = typename TestType::S;
    using R = typename TestType::R;
    require_random_machines(5000, rounds(40), 1, [](Random& random, const MachineSettings& machine) {
        const Program program = random_program(random, machine.axes);
        std::optional<Stream> stream;
        if (limits_for<S, R>(machine).has_value()) {
            stream = stream_of<S, R>(program, machine, random.chance(0.5) ? 32 : 256);
            require_ends(*stream, machine, program);
        }
        return stream;
    });
}

TEMPLATE_TEST_CASE("jerk-limited machines and Bezier segments", "[stream][jerk]", DoubleInDouble, FixedInDouble,
                   FixedInFloat) {
    using S = typename TestType::S;
    using R = typename TestType::R;
    require_random_machines(6000, rounds(25), 2, [](Random& random, const MachineSettings& machine) {
        const BezierPath path = random_path(random, machine.axes, 6, random.decades(0.05, 50.0), 0.3, 0.3);
        std::optional<Stream> stream;
        // Soft axes on long paths: minutes of the machine's time
        const auto limits = MotionLimits<double>::make(machine);
        if (limits_for<S, R>(machine).has_value() &&
            plan_of<double>(path, machine, 512).seconds() * limits->segments_per_s <= 1e5) {
            stream = stream_of<S, R>(path, machine, 256);
        }
        return stream;
    });
}

TEMPLATE_TEST_CASE("a jerk limit that no sampled motion reaches is kept without a plan for it", "[stream][jerk]",
                   double, Fixed) {
    using S = TestType;
    int runs = 0;
    for (std::uint64_t seed = 6500; seed < 6500 + static_cast<std::uint64_t>(rounds(40)); ++seed) {
        Random random(seed);
        MachineSettings machine = random_machine(random, random.integer(1, max_axes));
        const auto plain = MotionLimits<S>::make(machine);
        if (!plain.has_value()) {
            continue;
        }
        const double segment_s = 1.0 / to_double(plain->segments_per_s);
        MachineSettings limited = machine;
        for (AxisSettings& axis : limited.axis) {
            axis.max_jerk_mm_s3 = 1.0001 * (axis.max_acceleration_mm_s2 + axis.braking_mm_s2()) / segment_s;
        }
        const auto limits = MotionLimits<S>::make(limited);
        if (!limits.has_value()) { // beyond the range of a jerk limit
            continue;
        }
        CAPTURE(seed);
        REQUIRE_FALSE(limits->jerk_limited);
        require_limits(stream_of<S>(random_program(random, machine.axes), limited, 64), limited);
        limited.axis[0].max_jerk_mm_s3 *= 0.99;
        REQUIRE(MotionLimits<S>::make(limited)->jerk_limited);
        ++runs;
    }
    CHECK(runs > 0);
}

TEMPLATE_TEST_CASE("a straight move takes the time of the S-curve", "[stream][jerk]", double, float) {
    for (const double length : {0.1, 1.0, 10.0, 100.0}) {
        for (const double jerk : {1e4, 3e4, 1e5}) {
            const MachineSettings machine = with_jerk(machine_of(2, 100.0, 1000.0, 100.0), jerk);
            BezierPath path{cubic_shape(length / 3.0, 0.0, length / 1.5, 0.0, length, 0.0)};
            const Stream stream = stream_of<double, TestType>(path, machine, 256);
            const double segment_s = stream.segments[0].duration_ticks / 8e6;
            const double seconds = static_cast<double>(stream.segments.size()) * segment_s;
            const double least = SCurveProfile(length, {100.0, 1000.0, jerk}).duration_s();
            CAPTURE(length, jerk, seconds, least);
            CHECK(seconds <= (std::same_as<TestType, float> ? 1.003 : 1.001) * least + 3.0 * segment_s); // with a dwell
            CHECK(seconds >= least);
        }
    }
}

// The speed would rise with each part of the path that becomes known, and fall before its end.
TEMPLATE_TEST_CASE("where the window covers less than the way of braking, the speed is even", "[stream][jerk]",
                   DoubleInDouble, FixedInFloat) {
    const MachineSettings machine = with_jerk(machine_of(2, 300.0, 2000.0, 300.0), 20000.0);
    BezierPath wave; // of five millimetres, in pieces of half a one
    const auto height = [](double x) {
        return 5.0 * std::sin(x / 40.0);
    };
    const auto slope = [](double x) {
        return 5.0 / 40.0 * std::cos(x / 40.0);
    };
    for (int i = 0; i < 1000; ++i) {
        const double x = 0.5 * i;
        const double rise = height(x + 0.5) - height(x);
        wave.push_back(
            cubic_shape(0.5 / 3.0, 0.5 / 3.0 * slope(x), 1.0 / 3.0, rise - 0.5 / 3.0 * slope(x + 0.5), 0.5, rise));
    }
    double before_s = 60.0;
    for (const std::size_t window : {16U, 32U, 64U}) {
        const Stream stream = stream_of<typename TestType::S, typename TestType::R>(wave, machine, window);
        require_limits(stream, machine);
        double extreme = 0.0;
        double fastest = 0.0;
        int turns = 0; // of the speed, by more than 0.3 %
        bool rises = true;
        for (const FeedSegment& segment : stream.segments) {
            const double speed = std::hypot(static_cast<double>(segment.end[0] - segment.start[0]),
                                            static_cast<double>(segment.end[1] - segment.start[1])) /
                                 segment.duration_ticks;
            fastest = std::max(fastest, speed);
            if (rises ? speed < extreme - 0.003 * fastest : speed > extreme + 0.003 * fastest) {
                ++turns;
                rises = !rises;
            }
            extreme = turns % 2 == 0 ? std::max(extreme, speed) : std::min(extreme, speed);
        }
        const double seconds = static_cast<double>(stream.segments.size()) * stream.segments[0].duration_ticks / 8e6;
        CAPTURE(window, seconds);
        CHECK(turns <= 9); // four a wave, and the end
        CHECK(stream.limited > 10);
        CHECK(seconds < 0.8 * before_s);
        before_s = seconds;
    }
}

TEMPLATE_TEST_CASE("a jerk limit that is reached within the last digit of a cell", "[stream][jerk]", DoubleInDouble,
                   FixedInDouble, FixedInFloat) {
    using S = typename TestType::S;
    using R = typename TestType::R;
    // The phases of a straight move are shorter than what Fixed holds of a cell's length.
    // 6 s with sanitizers: 13 s of slow motion, of which the plan has many cells.
    for (const double jerk : {1e6, 1e9}) {
        const MachineSettings machine = with_jerk(machine_of(2, 100.0, 20.0, 100.0), jerk);
        CAPTURE(jerk);
        const BezierPath path{line_shape(2, 1, {60.0, 0.0}), line_shape(2, 1, {0.0, 40.0}),
                              line_shape(2, 1, {-0.3, 0.0})};
        const Stream stream = stream_of<S, R>(path, machine, 256);
        require_limits(stream, machine);
        require_ends(stream, machine, {}, {59.7, 40.0});
    }
}

TEMPLATE_TEST_CASE("a bend that begins behind the first of all cells", "[stream][jerk]", DoubleInDouble, FixedInDouble,
                   FixedInFloat) {
    using S = typename TestType::S;
    using R = typename TestType::R;
    // From a straight line into a circle: the acceleration jumps, but for a stop.
    const MachineSettings machine = with_jerk(machine_of(2, 100.0, 1000.0, 100.0), 1e5);
    for (const double length : {0.01, 0.03, 0.1, 0.3}) {
        for (const double radius : {0.1, 0.3, 1.0, 3.0}) {
            const double handle = 0.5522847498 * radius;
            const BezierPath path{line_shape(2, 1, {length, 0.0}),
                                  cubic_shape(handle, 0.0, radius, radius - handle, radius, radius)};
            CAPTURE(length, radius);
            const Stream stream = stream_of<S, R>(path, machine, 64);
            require_limits(stream, machine);
            require_ends(stream, machine, {}, {length + radius, radius});
        }
    }
}
