// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/setpoint/setpoint_bus.hpp"
#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::hal::modbus;

TEST_CASE("Target motion: where the track is about to end before the motion does, its clock stops on it") {
    SetpointMotion motion(100, 100'000);
    motion.ahead_us = 20'000;
    FeedSegment segment;
    segment.duration_ticks = 80'000; // 10 ms
    for (int i = 0; i < 30; ++i) {
        REQUIRE(motion.trajectory.push(segment));
    }
    motion.clock.start(0);
    std::uint64_t last = 0;
    for (std::uint64_t now = 0; now < 1'000'000; now += 500) {
        last = motion.time_us(now);
        REQUIRE(last + motion.ahead_us <= motion.trajectory.end_us() + 500); // it looks every 500 us
    }
    CHECK(motion.clock.at_standstill(1'000'000));
    CHECK(last > 270'000); // not earlier than it must

    SetpointMotion whole(100, 100'000);
    REQUIRE(whole.trajectory.push(segment));
    whole.complete = true;
    whole.clock.start(0);
    CHECK(whole.time_us(10'000) == 10'000);
    CHECK_FALSE(whole.clock.stopping());
}
