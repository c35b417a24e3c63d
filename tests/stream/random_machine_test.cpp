// SPDX-License-Identifier: MIT
//
// Random machines on random paths: whatever the limits, what is emitted keeps them, ends exactly, and ends at all.
#include "support/catch.hpp"
#include "support/emitted.hpp"
#include "support/rounds.hpp"

using namespace splinefeed_test;

namespace {

/// A generous bound of the number of segments: from rest to rest between every two points with the weakest axis alone,
/// and at every stop two segments and a part.
double most_seconds(const MachineSettings& machine, double length, double stops, double slowest_feed) {
    double acceleration = 1e9;
    double speed = std::min(machine.max_feed_mm_s, slowest_feed);
    for (const unsigned k : splinefeed::indices(machine.axes)) {
        acceleration = std::min(acceleration, machine.axis[k].max_acceleration_mm_s2);
        speed = std::min(speed, machine.axis[k].max_velocity_mm_s);
    }
    return length / speed + stops * (2.0 * speed / acceleration + 3.0 * machine.sample_period_us * 1e-6) +
           stops * 2.0 * std::sqrt(length / stops / acceleration);
}

struct Run {
    MachineSettings machine;
    Program program;
};

Run random_run(Random& random) {
    const int axes = random.integer(1, max_axes);
    Run run{random_machine(random, axes), random_program(random, axes)};
    return run;
}

template <class S>
void check_run(std::uint64_t seed, Used& worst) {
    Random random(seed);
    const Run run = random_run(random);
    if (!MotionLimits<S>::make(run.machine).has_value()) {
        return;
    }
    CAPTURE(seed, scalar_name<S>());
    const Stream stream = stream_of<S>(run.program, run.machine, random.chance(0.5) ? 16 : 512);
    const Used used = require_limits(stream, run.machine);
    worst.acceleration = std::max(worst.acceleration, used.acceleration);
    worst.velocity = std::max(worst.velocity, used.velocity);
    worst.feed = std::max(worst.feed, used.feed);
    require_ends(stream, run.machine, run.program);
    const std::vector<Point>& points = run.program.points;
    double chords = 0.0;
    double slowest = 1e9;
    for (std::size_t i = 1; i < points.size(); ++i) {
        double square = 0.0;
        for (const unsigned k : splinefeed::indices(run.program.axes)) {
            const double move = points[i].mm[k] - points[i - 1].mm[k];
            square += move * move;
        }
        chords += std::sqrt(square);
        slowest = std::min(slowest, points[i].feed_mm_s > 0.0 ? points[i].feed_mm_s : 1e9);
    }
    const double segment_s = stream.segments[0].duration_ticks / 8e6;
    // A spline is longer than its chords, and curvature slows down further: five times the crudest estimate
    const double most = 5.0 * most_seconds(run.machine, chords, static_cast<double>(points.size()), slowest);
    CHECK(static_cast<double>(stream.segments.size()) * segment_s <= most);
}

} // namespace

TEMPLATE_TEST_CASE("random machines, splines and polylines", "[stream][random]", double, float, Fixed) {
    Used worst;
    for (std::uint64_t seed = 1000; seed < 1000 + static_cast<std::uint64_t>(rounds(150)); ++seed) {
        check_run<TestType>(seed, worst);
    }
    CHECK(worst.velocity > 0.9L); // the machines were used
    CHECK(worst.acceleration > 0.9L);
}

TEMPLATE_TEST_CASE("random machines and Bezier segments", "[stream][random]", double, Fixed) {
    for (std::uint64_t seed = 2000; seed < 2000 + static_cast<std::uint64_t>(rounds(80)); ++seed) {
        Random random(seed);
        const int axes = random.integer(2, max_axes);
        const MachineSettings machine = random_machine(random, axes);
        const BezierPath path = random_path(random, axes, 6, random.decades(0.05, 50.0), 0.3, 0.3);
        const Stream stream = stream_of<TestType>(path, machine, 256);
        CAPTURE(seed, stream.segments.size());
        require_limits(stream, machine);
    }
}

TEMPLATE_TEST_CASE("an uneven parameter does not shake the axis", "[stream]", double, Fixed) {
    // Straight, so that all of the acceleration is used along the path: what is left of the error of the inverse
    // arc length is an acceleration of its own, v^2 times its second derivative.
    Random random(3);
    for (const double feed : {100.0, 300.0, 1000.0}) {
        for (const double acceleration : {300.0, 1000.0, 10000.0}) {
            for (const int period : {100, 1000}) {
                BezierPath path;
                for (int i = 0; i < 20; ++i) {
                    const double d = random.decades(5.0, 100.0);
                    const double x = random.between(0.05, 0.9);
                    path.push_back(cubic_shape(d * x, 0.0, d * random.between(x, 0.95), 0.0, d, 0.0));
                }
                const MachineSettings machine = machine_of(2, feed, acceleration, feed, period);
                CAPTURE(feed, acceleration, period);
                require_limits(stream_of<TestType>(path, machine, 4096), machine);
            }
        }
    }
}

TEMPLATE_TEST_CASE("a slow middle of a segment does not shake the axis", "[stream]", double, Fixed) {
    // Many uneven parameters at one speed: among them cells in whose middle the speed along the parameter is least,
    // where the error of the inverse does not show in the middle
    Random random(3);
    const MachineSettings machine = machine_of(2, 1000.0, 1000.0, 1000.0);
    for (int run = 0; run < rounds(20); ++run) {
        BezierPath path;
        for (int i = 0; i < 30; ++i) {
            const double d = random.decades(5.0, 100.0);
            const double x = random.between(0.05, 0.9);
            const double y = random.between(x, 0.95);
            path.push_back(cubic_shape(d * x, 0.0, d * y, 0.0, d, 0.0));
        }
        CAPTURE(run);
        require_limits(stream_of<TestType>(path, machine, 4096), machine);
    }
}

TEMPLATE_TEST_CASE("cusps inside of a segment keep every limit", "[stream]", double, Fixed) {
    for (const double acceleration : {10.0, 1000.0, 20000.0}) {
        for (const int period : {50, 250, 1000, 4000}) {
            const MachineSettings machine = machine_of(2, 100.0, acceleration, 100.0, period);
            if (!MotionLimits<TestType>::make(machine).has_value()) {
                continue;
            }
            // Fixed holds v^2 to 2^-32 in each of the graded cells, four for each of some fifteen halvings, that a
            // machine passes in its first segment; there v^2 is (A T)^2. And it holds lengths to 2^-33 mm: eight of
            // these, a random sum over sixty.
            const Real segment_s = real(period * 1e-6) / MotionLimits<TestType>::make(machine)->segments_per_sample;
            const Real reached = real(acceleration) * segment_s;
            const Real slack = std::same_as<TestType, Fixed>
                                   ? 64.0L * 0x1p-32L / (reached * reached) + 8.0L * 0x1p-33L / (reached * segment_s)
                                   : 0.0L;
            for (const TestShape& shape :
                 {cubic_shape(10.0, 10.0, 0.0, 10.0, 10.0, 0.0), cubic_shape(1.0, 0.0, 1.0, 0.0, 0.0, 0.0),
                  cubic_shape(1.0, 0.0, 1.0, 1e-6, 0.0, 0.0), cubic_shape(0.0, 0.0, 0.0, 0.0, 1.0, 0.0),
                  cubic_shape(1e-3, 1e-3, 1e-5, 1e-3, 1e-3, 0.0), cubic_shape(1e-3, 0.0, 1e-3, 0.0, 0.0, 0.0)}) {
                const Stream stream = stream_of<TestType>(BezierPath{shape}, machine);
                CAPTURE(acceleration, period, shape.offset[0][1], shape.offset[0][2], shape.offset[0][3]);
                require_limits(stream, machine, slack);
            }
        }
    }
}
