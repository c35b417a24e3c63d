// SPDX-License-Identifier: MIT
//
// Overrides and upper limits of the feed, against motions without.
#include "support/catch.hpp"
#include "support/emitted.hpp"
#include "support/steered_run.hpp"

#include <cmath>

using namespace splinefeed_test;

TEMPLATE_TEST_CASE("an override that hardly changes makes the motion no slower, and no feed is exceeded",
                   "[stream][steering]", double, Fixed) {
    const MachineSettings machine = machine_of(1, 100.0, 1000.0, 100.0);
    BezierPath path;
    for (const double feed : {10.0, 30.0, 30.0, 10.0, 20.0, 60.0, 60.0, 5.0, 5.0, 40.0}) {
        path.push_back(line_shape(1, 3, {2.0}));
        path.back().feed_mm_s = feed;
    }
    const SteeredRun plain = run_steered<TestType>(path, machine, 64, {});
    std::vector<Event> events;
    for (std::size_t at = 1; at + 1 < plain.segments.size(); at += 3) { // down to the last cell
        events.push_back({at, Order::override_feed, at % 2 == 0 ? 1.0 : 1.0 - 1e-7});
    }
    const SteeredRun run = run_steered<TestType>(path, machine, 64, events);
    REQUIRE(run.finished);
    require_limits(run, machine, 0.0L);
    CHECK(run.segments.back().end == plain.segments.back().end);
    CHECK(run.segments.size() <= plain.segments.size() + 1);
    // It may be sooner: what changes within a cell need not take all of it. But no feed is exceeded.
    for (const FeedSegment& segment : run.segments) {
        const Real at = static_cast<Real>(segment.end[0]) / units_per_mm(machine.axis[0]);
        const Real in_block = std::fmod(at, 2.0L);
        if (in_block > 0.2L && in_block < 1.8L) {
            const Real v = static_cast<Real>(segment.end_velocity[0]) / (units_per_mm(machine.axis[0]) * 1e-3L);
            CAPTURE(static_cast<double>(at), static_cast<double>(v));
            REQUIRE(v <= real(path[static_cast<std::size_t>(at / 2.0L)].feed_mm_s) * 1.0001L);
        }
    }
}

TEMPLATE_TEST_CASE("an upper limit of the feed is followed while the machine moves, and nothing else changes",
                   "[stream][steering]", double, float, Fixed) {
    using S = TestType;
    for (const double jerk : {0.0, 30'000.0}) {
        if (std::same_as<S, float> && jerk > 0.0) {
            continue;
        }
        const MachineSettings machine = with_jerk(machine_of(1, 200.0, 1000.0, 100.0), jerk);
        const BezierPath path{line_shape(1, 3, {60.0}), line_shape(1, 3, {40.0})};
        const SteeredRun plain = run_steered<S>(path, machine, 256, {});
        // Ten times the feed is no limit; then 30 mm/s beside an override of 2; then none again; then a stop.
        const SteeredRun run = run_steered<S>(path, machine, 256,
                                              {{50, Order::limit_feed, 1000.0},
                                               {300, Order::override_feed, 2.0},
                                               {300, Order::limit_feed, 30.0},
                                               {600, Order::limit_feed, 65'536.0},
                                               {601, Order::override_feed, 1.0},
                                               {700, Order::limit_feed, 0.0},
                                               {1000, Order::limit_feed, 100.0}});
        CAPTURE(jerk);
        REQUIRE(run.finished);
        require_limits(run, machine, std::same_as<S, float> ? 1e-3L : 0.0L);
        CHECK(run.segments.back().end == plain.segments.back().end);
        const auto speed = [&](std::size_t i) {
            return static_cast<double>(run.segments[i].end_velocity[0]) /
                   static_cast<double>(units_per_mm(machine.axis[0]) * 1e-3L);
        };
        for (std::size_t i = 0; i < 300; ++i) {
            const Real apart = static_cast<Real>(run.segments[i].end[0] - plain.segments[i].end[0]);
            REQUIRE(std::fabs(apart / units_per_mm(machine.axis[0])) < 0.05L); // a change ends cells sooner
        }
        CHECK(speed(299) == Approx(100.0).epsilon(2e-3));
        CHECK(speed(590) == Approx(30.0).epsilon(2e-3));
        CHECK(speed(590) <= 30.0);
        CHECK(speed(690) > 90.0);
        CHECK(speed(950) == 0.0);
    }
}

TEMPLATE_TEST_CASE("rapids have an override of their own, also while the machine moves", "[stream][steering]", double,
                   Fixed) {
    const MachineSettings machine = with_jerk(machine_of(1, 100.0, 1000.0, 100.0), GENERATE(0.0, 20000.0));
    BezierPath path;
    for (const double feed : {20.0, -1.0, 20.0}) { // a feed, a rapid, a feed; each 40 mm
        path.push_back(line_shape(1, 3, {40.0}));
        path.back().feed_mm_s = feed;
    }
    struct Fastest {
        Real feed = 0.0L;
        Real rapid = 0.0L;
    };
    const auto fastest = [&](const std::vector<Event>& events, Real rapid_from) {
        const SteeredRun run = run_steered<TestType>(path, machine, 64, events);
        REQUIRE(run.finished);
        require_limits(run, machine, 0.0L);
        Fastest out;
        for (const FeedSegment& segment : run.segments) {
            const Real at = static_cast<Real>(segment.end[0]) / units_per_mm(machine.axis[0]);
            const Real v = static_cast<Real>(segment.end_velocity[0]) / (units_per_mm(machine.axis[0]) * 1e-3L);
            if (at < 40.0L || at > 80.0L) {
                out.feed = std::max(out.feed, v);
            } else if (at > rapid_from) {
                out.rapid = std::max(out.rapid, v);
            }
        }
        return out;
    };
    const Fastest plain = fastest({}, 0.0L);
    CHECK(plain.rapid > 80.0L);
    const Fastest slow = fastest({{0, Order::override_rapids, 0.25}, {0, Order::override_feed, 2.0}}, 0.0L);
    CHECK(slow.rapid < 25.1L); // beside a feed that is faster than the rapid
    CHECK(slow.feed == Approx(40.0).epsilon(1e-2));
    const Fastest later = fastest({{2250, Order::override_rapids, 0.25}}, 70.0L);
    CHECK(later.rapid < 25.1L);
    CHECK(later.feed < 20.2L); // samples are averages, also where the feed changes
}

// What a spindle's reserve or a sender's limit says is in mm/s: a turn alone keeps its degrees a second.
TEMPLATE_TEST_CASE("an upper limit of the feed does not hold for turns alone", "[stream][steering]", double, Fixed) {
    MachineSettings machine = machine_of(2, 200.0, 1000.0, 100.0);
    machine.axis[1].rotary = true;
    BezierPath path{line_shape(2, 3, {0.0, 60.0}), line_shape(2, 3, {60.0, 0.0})};
    path[0].feed_mm_s = path[1].feed_mm_s = 100.0;
    const SteeredRun run = run_steered<TestType>(path, machine, 256, {{0, Order::limit_feed, 30.0}});
    REQUIRE(run.finished);
    require_limits(run, machine);
    std::array<double, 2> fastest{};
    for (const FeedSegment& segment : run.segments) {
        for (unsigned k = 0; k < 2; ++k) {
            fastest[k] = std::max(fastest[k], std::fabs(static_cast<double>(segment.end_velocity[k])) /
                                                  static_cast<double>(units_per_mm(machine.axis[k]) * 1e-3L));
        }
    }
    CHECK(fastest[0] == Approx(30.0).epsilon(2e-3));
    CHECK(fastest[1] == Approx(100.0).epsilon(2e-3));
}
