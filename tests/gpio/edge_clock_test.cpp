// SPDX-License-Identifier: MIT
// EdgeClock on hosts that are late at random: gaps, stretching, slowing down and going on.
#include "splinefeed/hal/gpio/edge_clock.hpp"
#include "support/catch.hpp"
#include "support/rounds.hpp"

#include <cmath>
#include <random>

using splinefeed::hal::gpio::EdgeClock;
using splinefeed::hal::gpio::EdgeClockSettings;

namespace {

constexpr std::uint64_t begin_ns = 1'000'000'000'000;

} // namespace

TEST_CASE("however late edges come, no gap is shorter than planned up to the guard, and delays are not caught up in a "
          "burst") {
    std::mt19937_64 random(7);
    for (int round = 0; round < splinefeed_test::rounds(300); ++round) {
        const EdgeClockSettings settings{.guard_ns = 1 + random() % 20'000, .tolerated_ns = random() % 200'000};
        EdgeClock clock(settings);
        clock.start(begin_ns, 0);
        std::int64_t motion = 0;
        std::uint64_t last = 0;
        std::uint64_t stretched = 0;
        for (int i = 0; i < 300; ++i) {
            const std::int64_t gap = 1 + static_cast<std::int64_t>(random() % (random() % 4 == 0 ? 300'000 : 10'000));
            motion += gap;
            const std::uint64_t due = clock.due_ns(motion);
            REQUIRE(due >= begin_ns + static_cast<std::uint64_t>(motion) + stretched);
            if (i > 0) {
                REQUIRE(due >= last + std::min(static_cast<std::uint64_t>(gap), settings.guard_ns));
            }
            const std::uint64_t wait = random() % 3 == 0 ? random() % 1'000'000 : random() % 1000;
            last = due + wait;
            const std::uint64_t late = clock.made(motion, last);
            REQUIRE(late == last - (begin_ns + static_cast<std::uint64_t>(motion) + stretched));
            stretched += late > settings.tolerated_ns ? late : 0;
            REQUIRE(clock.schedule_slip_ns() == stretched);
        }
    }
}

TEST_CASE("a host that stood still goes on where it was, also where time slows down just then") {
    std::mt19937_64 random(10);
    for (int round = 0; round < splinefeed_test::rounds(200); ++round) {
        const EdgeClockSettings settings{.guard_ns = 5000, .tolerated_ns = 100'000, .reserve_ns = 20'000'000};
        EdgeClock clock(settings);
        clock.start(begin_ns, 0);
        std::uint64_t now = begin_ns;
        std::int64_t motion = 0;
        std::uint64_t last = 0;
        for (int i = 0; i < 200; ++i) {
            const std::int64_t gap = 1000 + static_cast<std::int64_t>(random() % 200'000);
            motion += gap;
            now += random() % 10 == 0 ? random() % 300'000'000 : 0; // it stands still
            static_cast<void>(clock.absorb_delay(motion, now));
            if (random() % 20 == 0 && !clock.stopping()) {
                clock.stop(now);
            }
            std::uint64_t due = clock.due_ns(motion);
            if (due == EdgeClock::never) {
                now += 50'000'000;
                REQUIRE(clock.at_standstill(now));
                clock.resume(now);
                due = clock.due_ns(motion);
            }
            now = std::max(now, due);
            // No faster than planned, but for what is no delay yet.
            if (i > 0) {
                REQUIRE(now + settings.tolerated_ns >= last + static_cast<std::uint64_t>(gap));
            }
            static_cast<void>(clock.made(motion, now));
            last = now;
        }
    }
}

TEST_CASE("a host that is in time makes every edge at its instant") {
    EdgeClock clock({});
    clock.start(begin_ns, 1000);
    CHECK(clock.due_ns(0) == begin_ns - 1000); // a direction before the motion
    for (std::int64_t motion = 1000; motion < 1'000'000; motion += 777) {
        const std::uint64_t due = begin_ns + static_cast<std::uint64_t>(motion) - 1000;
        REQUIRE(clock.due_ns(motion) == due);
        REQUIRE(clock.motion_ns(due) == motion);
        REQUIRE(clock.made(motion, due) == 0);
    }
}

TEST_CASE("time slows down to stand over twice the reserve and goes on alike, at any rate") {
    std::mt19937_64 random(8);
    for (int round = 0; round < splinefeed_test::rounds(200); ++round) {
        const std::uint64_t reserve = 1'000'000 + random() % 50'000'000;
        EdgeClock clock({.guard_ns = 1, .tolerated_ns = 0, .reserve_ns = reserve});
        clock.start(begin_ns, 0);
        std::uint64_t at = begin_ns + random() % 1'000'000'000;
        double rate = 1.0;
        for (int stop = 0; stop < 4; ++stop) {
            const std::int64_t before = clock.motion_ns(at);
            clock.stop(at);
            CHECK(clock.stopping());
            CHECK_FALSE(clock.at_standstill(at));
            const auto falls = static_cast<std::uint64_t>(std::ceil(2.0 * static_cast<double>(reserve) * rate)) + 2;
            // What passes is reserve x rate^2, and no more, however long it stands.
            const double way = static_cast<double>(clock.motion_ns(at + falls) - before);
            CHECK(way == Approx(static_cast<double>(reserve) * rate * rate).margin(2.0));
            CHECK(clock.at_standstill(at + falls));
            CHECK(clock.motion_ns(at + 100 * falls) == clock.motion_ns(at + falls));
            CHECK(clock.due_ns(clock.motion_ns(at + falls) + 2) == EdgeClock::never);
            for (int i = 1; i < 20; ++i) { // the two directions of the same law
                const std::int64_t motion = before + static_cast<std::int64_t>(way * i / 20.0);
                CHECK(std::llabs(clock.motion_ns(clock.due_ns(motion)) - motion) <= 2);
            }
            at += falls + random() % 1'000'000'000;
            const std::int64_t stood = clock.motion_ns(at);
            clock.resume(at);
            CHECK_FALSE(clock.stopping());
            for (int i = 1; i < 30; ++i) {
                const std::int64_t motion = stood + static_cast<std::int64_t>(reserve) * i / 10;
                CHECK(std::llabs(clock.motion_ns(clock.due_ns(motion)) - motion) <= 2);
            }
            // The next stop comes in the middle of the rise, or behind it.
            const std::uint64_t goes = random() % (4 * reserve);
            rate = std::fmin(static_cast<double>(goes) / (2.0 * static_cast<double>(reserve)), 1.0);
            at += goes;
        }
    }
}

TEST_CASE("a clock keeps its law after hundreds of years") {
    constexpr std::uint64_t reserve = 20'000'000;
    for (const bool late : {false, true}) {
        const std::uint64_t now = late ? std::uint64_t{1} << 63U : 1'000'000'000; // 292 years after it was switched on
        const std::int64_t motion = late ? (std::int64_t{1} << 62U) : std::int64_t{0}; // of motion 146
        EdgeClock clock({.guard_ns = 5'000, .tolerated_ns = 100'000, .reserve_ns = reserve});
        clock.start(now, motion);
        CHECK(clock.due_ns(motion + 12'345) == now + 12'345);
        CHECK(clock.made(motion + 12'345, now + 12'345 + 250'000) == 250'000); // late: the motion moves
        CHECK(clock.due_ns(motion + 13'345) == now + 263'345);
        clock.stop(now + 1'000'000);
        CHECK(clock.at_standstill(now + 1'000'000 + 2 * reserve));
        CHECK(clock.motion_ns(now + 1'000'000 + 2 * reserve) - motion == 750'000 + std::int64_t{reserve});
        CHECK(clock.due_ns(motion + 100'000'000) == EdgeClock::never);
        clock.resume(now + 100'000'000);
        CHECK(clock.motion_ns(now + 100'000'000 + 4 * reserve) - motion == 750'000 + std::int64_t{4 * reserve});
    }
}
