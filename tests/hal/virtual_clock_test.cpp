// SPDX-License-Identifier: MIT
// The clock by which ports are tested is right itself.
#include "support/virtual_clock.hpp"

#include "support/catch.hpp"

#include <string>

using namespace splinefeed_test;

TEST_CASE("Virtual clock: time passes by sleeping alone, and threads take turns in order of their instants") {
    VirtualClock clock(0);
    std::string trace;
    const auto walk = [&](char name, std::uint64_t step_us, int steps) {
        for (int i = 0; i < steps; ++i) {
            trace += name;
            clock.sleep_us(step_us);
        }
    };
    {
        const auto a = clock.start([&] { walk('a', 10, 4); });
        const auto b = clock.start([&] { walk('b', 15, 2); });
        CHECK(trace.empty());
        clock.sleep_until_us(1000);
        CHECK(clock.now_us() == 1000);
        CHECK(trace == "ababaa"); // at 0 0 10 15 20 30
    }
    clock.sleep_until_us(5);
    CHECK(clock.now_us() == 1000);
}

TEST_CASE("Virtual clock: join waits in virtual time, also for a thread that another one started") {
    VirtualClock clock(0);
    bool inner = false;
    const auto outer = clock.start([&] {
        const auto thread = clock.start([&] {
            clock.sleep_us(50);
            inner = true;
        });
        thread->join();
        clock.sleep_us(50);
    });
    outer->join();
    CHECK(inner);
    CHECK(clock.now_us() == 100);
}
