// SPDX-License-Identifier: MIT
//
// Overrides of the feed, against motions without.
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
