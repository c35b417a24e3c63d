// SPDX-License-Identifier: MIT
#include "splinefeed/hal/rt/clock.hpp"

#include "support/catch.hpp"

#include <atomic>

using namespace splinefeed::hal;

TEST_CASE("Clock: the system's sleeps until the instant, not less, and not at all where it has passed") {
    Clock& clock = system_clock();
    const std::uint64_t before = clock.now_ns();
    clock.sleep_until_ns(before + 3'000'000);
    const std::uint64_t after = clock.now_ns();
    CHECK(after >= before + 3'000'000);
    clock.sleep_until_ns(before);
    clock.sleep_us(0);
    CHECK(clock.now_us() >= after / 1000);
}

TEST_CASE("Clock: a thread that it starts runs, and join returns behind its end") {
    std::atomic<bool> ended{false};
    const auto thread = system_clock().start([&] {
        system_clock().sleep_us(2000);
        ended = true;
    });
    thread->join();
    CHECK(ended);
    thread->join();
}

TEST_CASE("Clock: processor time of a thread does not pass while it sleeps") {
    const std::uint64_t before = thread_us();
    system_clock().sleep_us(20'000);
    CHECK(thread_us() - before < 10'000);
}
