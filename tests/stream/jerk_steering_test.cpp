// SPDX-License-Identifier: MIT
//
// Steering with limited jerk, judged on what was emitted: every limit, the end, the time that a hold takes.
#include "support/catch.hpp"
#include "support/emitted.hpp"
#include "support/random_steering.hpp"
#include "support/rounds.hpp"

#include "splinefeed/s3_feed_plan/jerk/s_curve_profile.hpp"

using namespace splinefeed_test;

namespace {

constexpr std::uint64_t seed = 2718;

MachineSettings jerk_machine() {
    return with_jerk(machine_of(2, 100.0, 1000.0, 100.0), 2e4);
}

/// The first segment from `at` on that ends at rest.
std::size_t rest_after(const SteeredRun& run, std::size_t at) {
    while (at < run.segments.size() && !ends_at_rest(run.segments[at], 2)) {
        ++at;
    }
    return at;
}

} // namespace

TEMPLATE_TEST_CASE("steered with limited jerk, limits and ends are kept", "[stream][jerk][steering]", DoubleInDouble,
                   FixedInDouble, FixedInFloat) {
    using S = typename TestType::S;
    using R = typename TestType::R;
    int steered = 0;
    Real most = 0.0L;
    const int runs = rounds(30, 600);
    for (std::uint64_t round = first_round(); round < static_cast<std::uint64_t>(runs); ++round) {
        Random random(seed + round);
        const int axes = random.integer(1, max_axes);
        MachineSettings machine = random_quick_machine(random, axes);
        limit_jerk(random, machine);
        const int pieces = random.chance(0.15) ? 3 : 8;
        const double size = random.decades(0.5, 50.0);
        const BezierPath path = random_path(random, axes, pieces, size, 0.15, 0.3);
        if (!limits_for<S, R>(machine).has_value()) {
            continue;
        }
        const std::size_t window = random.chance(0.5) ? 32 : 256;
        const SteeredRun plain = run_steered<S, R>(path, machine, window, {});
        CAPTURE(seed, round, window, plain.segments.size());
        if (plain.endless || plain.segments.size() > 20'000) {
            continue; // minutes of the machine's time
        }
        const std::vector<Event> events = random_events_and_abort(random, plain.segments.size());
        const SteeredRun run = run_steered<S, R>(path, machine, window, events);
        most = std::max(most, require_limits(run, machine).jerk);
        REQUIRE(run.finished);
        for (unsigned k = 0; k < static_cast<unsigned>(axes) && run.activity != Activity::aborted; ++k) {
            REQUIRE(run.segments.back().end[k] == plain.segments.back().end[k]);
        }
        ++steered;
    }
    CHECK(3 * steered > runs);
    CHECK(most > 0.9L);
}

TEMPLATE_TEST_CASE("a hold on a straight line takes the time of the ramps", "[stream][jerk][steering]", DoubleInDouble,
                   FixedInDouble, FixedInFloat) {
    using S = typename TestType::S;
    using R = typename TestType::R;
    const MachineSettings machine = jerk_machine();
    const BezierPath path{line_shape(2, 1, {60.0, 0.0})};
    const double segment_s = limits_for<S, R>(machine).value().segment_ticks / 8e6;
    const SteeredRun plain = run_steered<S, R>(path, machine, 256, {});
    for (std::size_t at = 3; at < plain.segments.size(); at += 31) {
        // Where the machine is when the segment starts that the hold acts with, a segment ahead
        const std::size_t then = std::min(at + 1, plain.segments.size() - 1);
        const AxisMotion m = motion_of(plain.segments[then], 0);
        const double scale = static_cast<double>(units_per_mm(machine.axis[0])) * segment_s;
        const MoveState state{0.0, static_cast<double>(m.v0) / scale, static_cast<double>(m.a0) / (scale * segment_s)};
        const double needs = SCurveProfile::to_rest(state, {100.0, 1000.0, 2e4}).duration_s();
        const SteeredRun run = run_steered<S, R>(path, machine, 256, {{at, Order::hold}, {at + 500, Order::resume}});
        require_limits(run, machine);
        const double took = static_cast<double>(rest_after(run, at) - at) * segment_s;
        CAPTURE(at, state.speed_mm_s, state.acceleration_mm_s2, took, needs);
        // The hold acts a segment ahead, and the last sample is repeated
        CHECK(took <= needs + 2e-3 + 2.0 * segment_s);
        REQUIRE(run.finished);
        REQUIRE(run.segments.back().end[0] == plain.segments.back().end[0]);
    }
}

TEMPLATE_TEST_CASE("a hold on a curve takes little more than braking with as much acceleration",
                   "[stream][jerk][steering]", DoubleInDouble, FixedInDouble, FixedInFloat) {
    using S = typename TestType::S;
    using R = typename TestType::R;
    const MachineSettings machine = jerk_machine();
    const BezierPath path{cubic_shape(20.0, 0.0, 40.0, 30.0, 60.0, 60.0),
                          cubic_shape(20.0, 30.0, 40.0, 30.0, 60.0, -20.0)};
    const auto limits = limits_for<S, R>(machine).value();
    const double segment_s = limits.segment_ticks / 8e6;
    const SteeredRun plain = run_steered<S, R>(path, machine, 256, {});
    const Track<S> track(path, machine);
    typename Track<S>::Place place;
    for (std::size_t at = 7; at + 1 < plain.segments.size(); at += 97) {
        static_cast<void>(track.find(plain.segments[at + 1], place));
        Real speed_sq = 0.0L;
        for (unsigned k = 0; k < 2; ++k) {
            const AxisMotion m = motion_of(plain.segments[at + 1], k);
            const Real v = static_cast<Real>(m.v0) / (units_per_mm(machine.axis[k]) * real(segment_s));
            speed_sq += v * v;
        }
        // Until the acceleration A is taken back with the jerk J the speed rises by A^2 / (2 J)
        const double rise_s = 1000.0 / (2.0 * 2e4);
        const double braking = static_cast<double>(track.braking_s(place, std::sqrt(speed_sq))) + rise_s;
        const SteeredRun run = run_steered<S, R>(path, machine, 256, {{at, Order::hold}, {at + 500, Order::resume}});
        require_limits(run, machine);
        const double took = static_cast<double>(rest_after(run, at) - at) * segment_s;
        CAPTURE(at, std::sqrt(static_cast<double>(speed_sq)), took, braking);
        // And it takes A / J to take it back, to brake as hard, and to end that.
        CHECK(took <= 1.1 * braking + 2.0 * 1000.0 / 2e4);
        REQUIRE(run.finished);
        REQUIRE(run.segments.back().end[0] == plain.segments.back().end[0]);
    }
}

TEMPLATE_TEST_CASE("an abort with limited jerk, and a new program after it", "[stream][jerk][steering]", DoubleInDouble,
                   FixedInDouble, FixedInFloat) {
    using S = typename TestType::S;
    using R = typename TestType::R;
    const MachineSettings machine = jerk_machine();
    const auto limits = limits_for<S, R>(machine).value();
    const BezierPath path{cubic_shape(20.0, 0.0, 40.0, 30.0, 60.0, 60.0), line_shape(2, 1, {20.0, 30.0})};
    for (const std::size_t at : {5U, 120U, 400U, 900U}) {
        CAPTURE(at);
        ListSource<S> source(segments_of<S>(path, {}), 0, 0);
        AnyTrajectory<S, R> any(source, limits, 256);
        SteeredRun run;
        run_steered<S>(any.trajectory(), {{at, Order::abort}}, run);
        REQUIRE(run.activity == Activity::aborted);
        require_limits(run, machine);
        PerAxis<double> start{};
        for (unsigned k = 0; k < 2; ++k) {
            start[k] = static_cast<double>(exact_mm(run.position[k]));
        }
        ListSource<S> next(segments_of<S>(BezierPath{line_shape(2, 1, {-10.0, 5.0})}, start), 0, 0);
        REQUIRE(any.trajectory().start(next).ok());
        run_steered<S>(any.trajectory(), {}, run);
        for (FeedSegment& segment : run.segments) {
            segment.waypoint = 0; // both programs count from 0
        }
        require_limits(run, machine);
        REQUIRE(run.finished);
        REQUIRE(run.segments.back().end[0] == target_units(start[0] - 10.0, machine.axis[0]));
    }
}

TEMPLATE_TEST_CASE("an override with limited jerk settles soon", "[stream][jerk][steering]", DoubleInDouble,
                   FixedInDouble, FixedInFloat) {
    using S = typename TestType::S;
    using R = typename TestType::R;
    // Micrometre-short segments, as a CAM program has them
    MachineSettings machine = jerk_machine();
    for (AxisSettings& axis : machine.axis) {
        axis.max_acceleration_mm_s2 = 5000.0;
        axis.max_jerk_mm_s3 = 1e6;
    }
    const BezierPath path(3000, line_shape(2, 3, {0.003, 0.004}));
    const double segment_s = limits_for<S, R>(machine).value().segment_ticks / 8e6;
    for (const double ratio : {0.3, 0.6}) {
        const SteeredRun run = run_steered<S, R>(path, machine, 512, {{60, Order::override_feed, ratio}});
        require_limits(run, machine);
        const auto late = static_cast<std::size_t>(60.0 + 0.05 / segment_s);
        REQUIRE(late < run.segments.size());
        const AxisMotion x = motion_of(run.segments[late], 0);
        const AxisMotion y = motion_of(run.segments[late], 1);
        const double scale = static_cast<double>(units_per_mm(machine.axis[0])) * segment_s;
        const double speed = std::hypot(static_cast<double>(x.v0), static_cast<double>(y.v0)) / scale;
        CAPTURE(ratio);
        CHECK(speed == Approx(100.0 * ratio).epsilon(1e-2));
    }
}

TEMPLATE_TEST_CASE("a pause by an override of 0 with limited jerk is no slower afterwards", "[stream][jerk][steering]",
                   DoubleInDouble, FixedInDouble, FixedInFloat) {
    using S = typename TestType::S;
    using R = typename TestType::R;
    for (std::uint64_t round = first_round(); round < static_cast<std::uint64_t>(rounds(12)); ++round) {
        Random random(seed + round);
        MachineSettings machine = jerk_machine();
        const BezierPath path = random_path(random, 2, 6, random.decades(1.0, 20.0), 0.15, 0.3);
        const SteeredRun plain = run_steered<S, R>(path, machine, 256, {});
        // Before it starts, and in the middle: there it has to stop and start again
        for (const std::size_t at : {std::size_t{0}, plain.segments.size() / 2}) {
            const SteeredRun run = run_steered<S, R>(
                path, machine, 256, {{at, Order::override_feed, 0.0}, {at + 300, Order::override_feed, 1.0}});
            CAPTURE(seed, round, at, plain.segments.size(), run.segments.size());
            require_limits(run, machine);
            REQUIRE(run.finished);
            // The pause, and v / A + A / J = 150 ms each to stop and to start; a tenth where a leg is cut badly
            CHECK(static_cast<double>(run.segments.size()) <=
                  1.1 * static_cast<double>(plain.segments.size()) + (at == 0 ? 302.0 : 600.0));
        }
    }
}

TEMPLATE_TEST_CASE("overrides that follow each other next to a corner leave it a stop", "[stream][jerk][steering]",
                   DoubleInDouble, FixedInDouble, FixedInFloat) {
    using S = typename TestType::S;
    using R = typename TestType::R;
    MachineSettings machine = machine_of(2, 100.0, 20.0, 100.0); // some segments in the last cell, in two phases
    machine.axis[0].max_jerk_mm_s3 = machine.axis[1].max_jerk_mm_s3 = 1e6;
    const BezierPath path{line_shape(2, 3, {0.3, 0.0}), line_shape(2, 3, {0.0, 0.3})};
    const SteeredRun plain = run_steered<S, R>(path, machine, 32, {});
    const std::size_t corner = rest_after(plain, 1);
    for (std::size_t at = corner - 30; at < corner; ++at) {
        const SteeredRun run = run_steered<S, R>(path, machine, 32,
                                                 {{at, Order::override_feed, 0.9},
                                                  {at + 1, Order::override_feed, 0.8},
                                                  {at + 2, Order::override_feed, 0.7}});
        CAPTURE(at, corner);
        require_limits(run, machine);
        REQUIRE(run.finished);
        REQUIRE(run.segments.back().end == plain.segments.back().end);
    }
}
