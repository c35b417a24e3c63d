// SPDX-License-Identifier: MIT
#include "splinefeed/hal/rt/motion_clock.hpp"
#include "support/catch.hpp"
#include "support/rounds.hpp"

#include <cmath>
#include <cstdlib>
#include <random>

using splinefeed::hal::MotionClock;

TEST_CASE("Motion clock: it stands before its start, and then runs as ours does") {
    MotionClock clock(100'000);
    CHECK(clock.time(123'456) == 0);
    clock.start(1'000'000);
    CHECK(clock.time(1'000'000) == 0);
    CHECK(clock.time(1'000'001) == 1);
    CHECK(clock.time(9'000'000) == 8'000'000);
    CHECK_FALSE(clock.at_standstill(9'000'000));
}

TEST_CASE("Motion clock: a stop takes the reserve of motion in twice its time, a resume the same") {
    MotionClock clock(100'000);
    clock.start(0);
    clock.stop(1'000'000);
    CHECK(clock.time(1'000'000) == 1'000'000);
    CHECK(clock.time(1'100'000) == 1'075'000); // t - t^2 / 4 S
    CHECK_FALSE(clock.at_standstill(1'199'999));
    CHECK(clock.at_standstill(1'200'000));
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
    const unsigned seed = splinefeed_test::random_seed();
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
            } else if (clock.at_standstill(now) && random() % 50 == 0) {
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

TEST_CASE("Motion clock: instants are when the motion's time is that, and what comes later is delayed by as much") {
    std::mt19937_64 random(11);
    for (int round = 0; round < 200; ++round) {
        const std::uint64_t reserve = 1'000'000 + random() % 50'000'000;
        MotionClock clock(reserve);
        std::uint64_t at = 1'000'000'000 + random() % 1'000'000'000;
        clock.start(at);
        CHECK(clock.instant(-700) == at - 700); // before its beginning
        for (int stop = 0; stop < 3; ++stop) {
            const std::uint64_t runs = random() % (4 * reserve);
            for (int i = 1; i <= 10; ++i) {
                const auto time = static_cast<std::int64_t>(clock.time(at + runs * static_cast<unsigned>(i) / 10));
                CHECK(std::llabs(static_cast<std::int64_t>(clock.time(clock.instant(time))) - time) <= 2);
            }
            at += runs;
            const auto passed = static_cast<std::int64_t>(clock.time(at));
            clock.stop(at);
            CHECK(clock.instant(passed - 5) == at); // due then at the latest
            const auto stands = static_cast<std::int64_t>(clock.time(clock.standstill_from()));
            CHECK(clock.instant(stands + 2) == MotionClock::never);
            const std::int64_t halfway = (passed + stands) / 2;
            const std::uint64_t due = clock.instant(halfway);
            CHECK(std::llabs(static_cast<std::int64_t>(clock.time(due)) - halfway) <= 2);
            clock.delay(1234);
            CHECK(clock.instant(halfway) == due + 1234);
            CHECK(clock.at_standstill(clock.standstill_from()));
            at = clock.standstill_from() + random() % 1'000'000;
            clock.resume(at);
            CHECK(clock.instant(stands) == at);
        }
        clock.start(at); // anew
        CHECK(clock.time(at + 5 * reserve) == 5 * reserve);
    }
}
