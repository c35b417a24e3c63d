// SPDX-License-Identifier: MIT
#include "splinefeed/hal/rt/motion_clock.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <random>

using splinefeed::hal::MotionClock;

TEST_CASE("Motion clock: it stands before its start, and then runs as ours does") {
    MotionClock clock(100'000);
    CHECK(clock.time(123'456) == 0);
    clock.start(1'000'000);
    CHECK(clock.time(1'000'000) == 0);
    CHECK(clock.time(1'000'001) == 1);
    CHECK(clock.time(9'000'000) == 8'000'000);
    CHECK_FALSE(clock.stands(9'000'000));
}

TEST_CASE("Motion clock: a stop takes the reserve of motion in twice its time, a resume the same") {
    MotionClock clock(100'000);
    clock.start(0);
    clock.stop(1'000'000);
    CHECK(clock.time(1'000'000) == 1'000'000);
    CHECK(clock.time(1'100'000) == 1'075'000); // t - t^2 / 4 S
    CHECK_FALSE(clock.stands(1'199'999));
    CHECK(clock.stands(1'200'000));
    CHECK(clock.time(1'200'000) == 1'100'000);
    CHECK(clock.time(5'000'000) == 1'100'000);
    clock.resume(5'000'000);
    CHECK_FALSE(clock.stopping());
    CHECK(clock.time(5'000'000) == 1'100'000);
    CHECK(clock.time(5'100'000) == 1'125'000);
    CHECK(clock.time(5'200'000) == 1'200'000);
    CHECK(clock.time(6'200'000) == 2'200'000);
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
            const auto next = static_cast<double>(clock.time(now + step_us) - clock.time(now)) / step_us;
            const double most = 1.1 * step_us / (2.0 * static_cast<double>(reserve_us)) + 0.003; // whole microseconds
            REQUIRE(clock.time(now + step_us) >= clock.time(now));
            REQUIRE(std::fabs(next - rate) < most);
            rate = next;
        }
    }
}
