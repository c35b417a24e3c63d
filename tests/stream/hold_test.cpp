// SPDX-License-Identifier: MIT
//
// Holds at any time.
#include "support/catch.hpp"
#include "support/emitted.hpp"
#include "support/steered_run.hpp"

using namespace splinefeed_test;

TEMPLATE_TEST_CASE("no segment of a hold is spent at standstill", "[stream][steering]", double, Fixed) {
    const MachineSettings machine = machine_of(1, 100.0, 1000.0, 100.0);
    for (const double feed : {100.0, 0.3}) { // from the second a stop takes less than a segment
        BezierPath path{line_shape(1, 3, {feed * 0.003})};
        path[0].feed_mm_s = feed;
        const SteeredRun plain = run_steered<TestType>(path, machine, 64, {});
        for (std::size_t at = 1; at < plain.segments.size(); ++at) { // next to rest, too
            const SteeredRun run = run_steered<TestType>(path, machine, 64, {{at, Order::hold}});
            CAPTURE(feed, at);
            require_limits(run, machine);
            for (const FeedSegment& segment : run.segments) {
                REQUIRE((segment.start != segment.end || segment.start_velocity[0] != 0));
            }
        }
    }
}

TEMPLATE_TEST_CASE("an override holds to the end of a leg, whatever is held on the way", "[stream][jerk]",
                   DoubleInDouble, FixedInDouble, FixedInFloat) {
    using S = typename TestType::S;
    using R = typename TestType::R;
    MachineSettings machine = machine_of(1, 100.0, 1000.0, 100.0);
    for (const double jerk : {1e5, 1e7}) {
        machine.axis[0].max_jerk_mm_s3 = jerk;
        for (const double ratio : {0.05, 0.2}) {
            const Event slow{0, Order::override_feed, ratio};
            const BezierPath path{line_shape(1, 3, {2.0 * ratio})};
            const SteeredRun plain = run_steered<S, R>(path, machine, 64, {slow});
            for (std::size_t at = 1; at < plain.segments.size(); at += 2) {
                const SteeredRun run =
                    run_steered<S, R>(path, machine, 64, {slow, {at, Order::hold}, {at + 60, Order::resume}});
                CAPTURE(jerk, ratio, at);
                REQUIRE(run.finished);
                REQUIRE(run.segments.back().end == plain.segments.back().end);
                for (const FeedSegment& segment : run.segments) {
                    const Real speed =
                        static_cast<Real>(segment.end_velocity[0]) / (units_per_mm(machine.axis[0]) * 1e-3L);
                    REQUIRE(speed <= 100.0L * real(ratio) * 1.0001L);
                }
            }
        }
    }
}
