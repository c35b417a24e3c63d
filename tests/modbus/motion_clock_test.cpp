// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/setpoint/motion_clock.hpp"

#include "splinefeed/hal/modbus/setpoint/setpoint_bus.hpp"
#include "support/catch.hpp"

#include <random>

using namespace splinefeed;
using namespace splinefeed::hal::modbus;

TEST_CASE("Motion clock: it stands before its start, and then runs as ours does") {
    MotionClock clock(100'000);
    CHECK(clock.time_us(123'456) == 0);
    clock.start(1'000'000);
    CHECK(clock.time_us(1'000'000) == 0);
    CHECK(clock.time_us(1'000'001) == 1);
    CHECK(clock.time_us(9'000'000) == 8'000'000);
    CHECK_FALSE(clock.stands(9'000'000));
}

TEST_CASE("Motion clock: a stop takes the reserve of motion in twice its time, a resume the same") {
    MotionClock clock(100'000);
    clock.start(0);
    clock.stop(1'000'000);
    CHECK(clock.time_us(1'000'000) == 1'000'000);
    CHECK(clock.time_us(1'100'000) == 1'075'000); // t - t^2 / 4 S
    CHECK_FALSE(clock.stands(1'199'999));
    CHECK(clock.stands(1'200'000));
    CHECK(clock.time_us(1'200'000) == 1'100'000);
    CHECK(clock.time_us(5'000'000) == 1'100'000);
    clock.resume(5'000'000);
    CHECK_FALSE(clock.stopping());
    CHECK(clock.time_us(5'000'000) == 1'100'000);
    CHECK(clock.time_us(5'100'000) == 1'125'000);
    CHECK(clock.time_us(5'200'000) == 1'200'000);
    CHECK(clock.time_us(6'200'000) == 2'200'000);
}

TEST_CASE("Motion clock: its rate changes by 1 within twice the reserve at most, and it never goes back") {
    const unsigned seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937 random(seed);
    for (int round = 0; round < 200; ++round) {
        const std::uint64_t reserve_us = 10'000 + random() % 200'000;
        MotionClock clock(reserve_us);
        clock.start(1000);
        constexpr std::uint64_t step_us = 1000;
        double rate = 1.0;
        for (std::uint64_t now = 1000; now < 3'000'000; now += step_us) {
            if (!clock.stopping() && random() % 300 == 0) { // also while it still rises
                clock.stop(now);
            } else if (clock.stands(now) && random() % 50 == 0) {
                clock.resume(now);
            }
            const auto next = static_cast<double>(clock.time_us(now + step_us) - clock.time_us(now)) / step_us;
            const double most = 1.1 * step_us / (2.0 * static_cast<double>(reserve_us)) + 0.003; // whole microseconds
            REQUIRE(clock.time_us(now + step_us) >= clock.time_us(now));
            REQUIRE(std::fabs(next - rate) < most);
            rate = next;
        }
    }
}

TEST_CASE("Target motion: where the track is about to end before the motion does, its clock stops on it") {
    SetpointMotion motion(100, 100'000);
    motion.ahead_us = 20'000;
    FeedSegment segment;
    segment.duration_ticks = 80'000; // 10 ms
    for (int i = 0; i < 30; ++i) {
        REQUIRE(motion.track.push(segment));
    }
    motion.clock.start(0);
    std::uint64_t last = 0;
    for (std::uint64_t now = 0; now < 1'000'000; now += 500) {
        last = motion.time_us(now);
        REQUIRE(last + motion.ahead_us <= motion.track.end_us() + 500); // it looks every 500 us
    }
    CHECK(motion.clock.stands(1'000'000));
    CHECK(last > 270'000); // not earlier than it must

    SetpointMotion whole(100, 100'000);
    REQUIRE(whole.track.push(segment));
    whole.complete = true;
    whole.clock.start(0);
    CHECK(whole.time_us(10'000) == 10'000);
    CHECK_FALSE(whole.clock.stopping());
}
