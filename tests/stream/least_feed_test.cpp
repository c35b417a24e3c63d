// SPDX-License-Identifier: MIT
//
// The least feed and the least axis velocity that a machine file takes, 0.001 mm/s.
#include "support/catch.hpp"
#include "support/emitted.hpp"
#include "support/steered_run.hpp"

using namespace splinefeed_test;

TEMPLATE_TEST_CASE("the least feed and the least velocity are kept, also held and overridden", "[stream][limits]",
                   double, Fixed) {
    for (const double jerk : {0.0, 1e4}) {
        for (const bool of_axes : {false, true}) {
            const MachineSettings machine =
                with_jerk(machine_of(2, of_axes ? 0.001 : 100.0, 1000.0, of_axes ? 100.0 : 0.001), jerk);
            const BezierPath path{line_shape(2, 3, {0.0007, 0.0003}), line_shape(2, 3, {0.0, 0.0006})};
            for (const std::vector<Event>& events : {std::vector<Event>{},
                                                     {{300, Order::hold}, {500, Order::resume}},
                                                     {{100, Order::override_feed, 0.5}}}) {
                CAPTURE(jerk, of_axes, events.size());
                const SteeredRun run = run_steered<TestType>(path, machine, 64, events);
                REQUIRE(run.finished);
                REQUIRE(run.segments.size() < 2200); // 1.36 um in 1.36 s, and the pause
                require_limits(run, machine);
            }
        }
    }
}
