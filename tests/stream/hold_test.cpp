// SPDX-License-Identifier: MIT
//
// Holds at any time.
#include "support/catch.hpp"
#include "support/emitted.hpp"
#include "support/steered_run.hpp"

using namespace splinefeed_test;

TEMPLATE_TEST_CASE("no segment of a hold is spent at standstill", "[stream][steering]", double, Fixed) {
    const MachineSettings machine = machine_of(1, 100.0, 1000.0, 100.0);
    const BezierPath path{line_shape(1, 3, {0.3})};
    const SteeredRun plain = run_steered<TestType>(path, machine, 64, {});
    for (std::size_t at = 1; at < plain.segments.size(); ++at) { // next to rest, too
        const SteeredRun run = run_steered<TestType>(path, machine, 64, {{at, Order::hold}});
        CAPTURE(at);
        require_limits(run, machine);
        for (const FeedSegment& segment : run.segments) {
            REQUIRE((segment.start != segment.end || segment.start_velocity[0] != 0));
        }
    }
}
