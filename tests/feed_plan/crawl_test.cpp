// SPDX-License-Identifier: MIT
//
// Ways too short for a speed: as slow as it takes, whatever the path does.
#include "splinefeed/s3_feed_plan/limits/crawl.hpp"

#include "support/catch.hpp"
#include "support/pipeline.hpp"

using namespace splinefeed_test;

TEMPLATE_TEST_CASE("crawling keeps every limit on the worst of paths, and no more than that", "[feed_plan][limits]",
                   double, Fixed) {
    using S = TestType;
    Random random(70411);
    int slow = 0;
    for (int round = 0; round < 2000; ++round) {
        const int axes = random.integer(1, max_axes);
        MachineSettings machine = machine_of(axes, 100.0, 1000.0, 100.0, random.integer(50, 8000));
        for (AxisSettings& axis : machine.axis) {
            axis.max_acceleration_mm_s2 = random.decades(1.0, 1e5);
            axis.max_jerk_mm_s3 = axis.max_acceleration_mm_s2 / random.decades(1e-5, 1.0);
        }
        const auto limits = MotionLimits<S>::make(machine);
        if (!limits.has_value()) {
            continue;
        }
        const Real way = real(random.decades(1e-8, 1e-6));
        const Real ticks = exact(crawling_ticks(from_double<S>(static_cast<double>(way)), *limits));
        const Real segment_s = 1.0L / exact(limits->segments_per_s);
        const Real step = way / ticks; // of a path that turns round at every sample: c = 0, 1, 0, 1
        Real most = 0.0L;
        for (const unsigned k : splinefeed::indices(axes)) {
            const AxisSettings& axis = machine.axis[k];
            most = std::max(most, 2.0L * step / (segment_s * segment_s) / real(axis.max_acceleration_mm_s2));
            most = std::max(most, 4.0L * step / (segment_s * segment_s * segment_s) / real(axis.max_jerk_mm_s3));
        }
        CAPTURE(round, static_cast<double>(way), static_cast<double>(ticks), static_cast<double>(most));
        REQUIRE(most <= 1.0L);
        REQUIRE(ticks >= 1.0L);
        REQUIRE(ticks < 1000.0L);
        if (ticks > 1.0L) {
            REQUIRE(most > 0.6L); // what planning leaves to rounding is a quarter at most
            ++slow;
        }
    }
    CHECK(slow > 20);
}
