// SPDX-License-Identifier: MIT
#include "splinefeed/hal/gpio/step_log.hpp"
#include "support/catch.hpp"

#include <random>
#include <thread>

using namespace splinefeed;
using namespace splinefeed::hal::gpio;

TEST_CASE("a log tells where the axes stood at any instant that was not asked for before") {
    std::mt19937_64 random(9);
    StepLog log;
    StepLog::Reader reader(log);
    PerAxis<std::int64_t> counts{};
    std::uint64_t now = 1000;
    for (int i = 0; i < 200'000; ++i) {
        now += random() % 100;
        const auto axis = static_cast<unsigned>(random() % 3);
        const bool up = random() % 2 == 0;
        const PerAxis<std::int64_t> before = counts;
        log.add(now, axis, up);
        counts[axis] += up ? 1 : -1;
        if (random() % 50 == 0) {
            const auto just_before = reader.counts_at(now - 1);
            if (just_before) { // another step may have been at the same instant
                REQUIRE(std::llabs((*just_before)[axis] - before[axis]) <= 1);
            }
            REQUIRE(reader.counts_at(now) == counts);
        }
    }
    CHECK_FALSE(reader.counts_at(now / 2).has_value()); // asked for too late
    CHECK(reader.counts_at(now) == counts);
}

TEST_CASE("instants of steps wrap after 36 years, and the steps stay in order") {
    constexpr std::uint64_t wrap = std::uint64_t{1} << 60U;
    StepLog log;
    StepLog::Reader reader(log);
    for (std::uint64_t i = 0; i < 20; ++i) {
        log.add(wrap - 10 + i, 0, true);
    }
    CHECK(reader.counts_at(wrap - 11).value()[0] == 0);
    CHECK(reader.counts_at(wrap - 1).value()[0] == 10);
    CHECK(reader.counts_at(wrap + 4).value()[0] == 15);
    CHECK_FALSE(reader.counts_at(wrap - 1).has_value()); // asked for too late
    CHECK(reader.counts_at(wrap + 100).value()[0] == 20);
}

TEST_CASE("a reader that lost steps says so") {
    StepLog log;
    StepLog::Reader reader(log);
    for (unsigned i = 0; i < (1U << 16U) - 1; ++i) {
        log.add(i, 0, true);
    }
    CHECK(reader.counts_at(10).value()[0] == 11);
    StepLog::Reader late(log);
    for (unsigned i = 0; i < 20; ++i) {
        log.add(1U << 16U, 0, true);
    }
    CHECK_FALSE(late.counts_at(1U << 20U).has_value());
    CHECK(reader.counts_at(1U << 20U).has_value() == false);
}

TEST_CASE("steps are read while they are written, and none is missing") {
    StepLog log;
    constexpr unsigned steps = 400'000;
    constexpr std::uint64_t after_all = steps; // an instant
    constexpr unsigned most_ahead = 60'000;    // or the log would lose some
    std::atomic<unsigned> written{0};
    std::atomic<unsigned> read{0};
    std::thread writer([&] {
        for (unsigned i = 0; i < steps; ++i) {
            while (i > read.load() + most_ahead) {
                std::this_thread::yield();
            }
            log.add(i, i % 2, i % 8 >= 2); // of four steps of an axis one goes down
            written.store(i + 1);
        }
    });
    StepLog::Reader reader(log);
    bool complete = true;
    while (read.load() < steps && complete) {
        const unsigned before = written.load();
        complete = reader.counts_at(after_all).has_value();
        read.store(before);
    }
    read.store(steps);
    writer.join();
    REQUIRE(complete);
    const auto counts = reader.counts_at(after_all);
    CHECK((*counts)[0] == steps / 4);
    CHECK((*counts)[1] == steps / 4);
}
