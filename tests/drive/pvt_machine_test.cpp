// SPDX-License-Identifier: MIT
// How a drive slows down at the end of its ring, holds, resumes, and trips.
#include "pvt_bench.hpp"
#include "support/catch.hpp"
#include "support/rounds.hpp"

#include <algorithm>

using namespace splinefeed_test;

namespace {

constexpr double reserve_s = 0.1;

/// sigma of the document in small steps: what the drive does in closed form.
struct SteppedRate {
    double way = 0.0;
    double sigma = 1.0;

    void pass(double time, double ring, bool holds) {
        constexpr double h = 1e-6;
        for (double t = 0.0; t < time - h / 2; t += h) {
            const double left = std::max(ring - way, 0.0);
            const double up = std::min(sigma + h / (2.0 * reserve_s), 1.0);
            sigma = holds ? std::max(sigma - h / (2.0 * reserve_s), 0.0) : std::min(up, std::sqrt(left / reserve_s));
            way += sigma * h;
        }
    }
};

} // namespace

TEST_CASE("PVT drive: it slows down to the end of its ring as the document says, on the path", "[drive][pvt]") {
    PvtBench bench(2);
    bench.begin();
    static_cast<void>(bench.feed(0, steady(2, 4, 400000, 1000.0)));
    bench.start_now();
    SteppedRate stepped;
    stepped.sigma = 1.0;
    for (int i = 0; i < 80; ++i) {
        bench.wait_us(5000);
        stepped.pass(0.005, 0.2, false);
        // A segment from rest, then steady: the second axis is always at twice the way of the first.
        const double first = bench.drive.position_counts(0);
        REQUIRE(bench.drive.position_counts(1) == Approx(2.0 * first).margin(1e-6));
        REQUIRE(bench.drive.machine().rate() == Approx(stepped.sigma).margin(1e-3));
        REQUIRE(first == Approx(static_cast<double>(hermite(steady(2, 4, 400000, 1000.0), 0,
                                                            static_cast<long double>(stepped.way) * 8e6L)))
                             .margin(0.02));
    }
    CHECK(bench.state() == PvtState::held);
    CHECK(bench.status().executed == 4);
    CHECK(bench.drive.position_counts(0) == 200.0);
    // From R = S on it takes 2 S.
    CHECK(bench.executed.back().end_us == Approx((0.1 + 2.0 * reserve_s) * 1e6).margin(1.0));

    // More segments wait for a resume, and then it goes on from where it stands.
    static_cast<void>(bench.feed(4, steady(2, 4, 400000, 1000.0, 4)));
    bench.wait_us(100000);
    CHECK(bench.drive.position_counts(0) == 200.0);
    static_cast<void>(bench.command(PvtCommand::resume, bench.status().clock_us + 1000));
    bench.wait_us(1000);
    CHECK(bench.drive.position_counts(0) == 200.0);
    bench.wait_us(1000);
    // sigma = t / 2 S
    CHECK(bench.drive.position_counts(0) - 200.0 == Approx(1000.0 * 1e-6 / (4.0 * reserve_s)).epsilon(1e-6));
    bench.wait_us(1'000'000);
    CHECK(bench.drive.position_counts(0) == 400.0);
}

TEST_CASE("PVT drive: drives with the same contents stay together, however their time is cut", "[drive][pvt]") {
    const auto seed = random_seed();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    for (int round = 0; round < rounds(15); ++round) {
        auto segments = random_segments(random, 2, 40, 50.0);
        segments.back().rest = random() % 2 == 0;
        for (PvtSegment& segment : segments) {
            // The second drive's axis stands at some joints where the first one's moves.
            segment.end_velocity[1] = random() % 3 == 0 ? 0 : segment.end_velocity[1];
        }
        auto second = segments;
        for (PvtSegment& segment : second) {
            std::swap(segment.end[0], segment.end[1]);
            std::swap(segment.end_velocity[0], segment.end_velocity[1]);
        }
        PvtDriveParameters parameters;
        parameters.clock_start_us = random();
        PvtBench a(1);
        PvtBench b(1, parameters);
        PvtBench both(2);
        for (PvtBench* bench : {&a, &b, &both}) {
            bench->begin();
        }
        const auto each = [&](PvtCommand command, std::uint32_t in_us) {
            for (PvtBench* bench : {&a, &b, &both}) {
                static_cast<void>(bench->command(command, bench->status().clock_us + in_us));
            }
        };
        std::size_t fed = 0;
        const auto feed = [&](std::size_t count) {
            for (; count > 0 && fed < segments.size(); --count, ++fed) {
                const auto n = static_cast<std::uint32_t>(fed);
                static_cast<void>(a.feed(n, {segments[fed]}));
                static_cast<void>(b.feed(n, {second[fed]}));
                static_cast<void>(both.feed(n, {segments[fed]}));
            }
        };
        feed(10);
        each(PvtCommand::start, 5000);
        for (int step = 0; step < 150; ++step) {
            const std::uint64_t time = 1 + random() % 3000;
            a.wait_us(time);
            const std::uint64_t part = random() % time;
            b.wait_us(part);
            b.wait_us(time - part);
            for (std::uint64_t i = 0; i < 7; ++i) {
                both.wait_us(i == 6 ? time - 6 * (time / 7) : time / 7);
            }
            const auto alike = [&] {
                return a.state() == both.state() && b.state() == both.state() &&
                       a.status().executed == b.status().executed;
            };
            if (!alike()) {
                // Just at the instant of an event rounding decides; near rest it moves the instant by 2 S sqrt(1e-10),
                // 2 us.
                for (PvtBench* bench : {&a, &b, &both}) {
                    bench->wait_us(5);
                }
            }
            REQUIRE(alike());
            if (random() % 6 == 0) {
                feed(random() % 6);
            }
            if (random() % 20 == 0) {
                each(a.state() == PvtState::held ? PvtCommand::resume : PvtCommand::hold,
                     static_cast<std::uint32_t>(random() % 4000));
            }
            REQUIRE(std::fabs(a.drive.position_counts(0) - both.drive.position_counts(0)) < 1e-6);
            REQUIRE(std::fabs(b.drive.position_counts(0) - both.drive.position_counts(1)) < 1e-6);
        }
    }
}

TEST_CASE("PVT drive: a motion that goes on behind a place to stand does not jump", "[drive][pvt]") {
    PvtBench bench(1);
    bench.begin();
    auto segments = steady(1, 3, 80000, 0.0); // 30 ms, from rest to rest
    segments[2].rest = true;
    segments[0].end[0] = 10 << 16;
    segments[1].end[0] = 20 << 16;
    segments[2].end[0] = 30 << 16;
    segments[0].end_velocity[0] = segments[1].end_velocity[0] = 10 << 24;
    static_cast<void>(bench.feed(0, segments));
    bench.start_now();
    bench.wait_us(15000);
    CHECK(bench.drive.machine().rate() == 1.0);
    auto more = segments[0];
    more.end[0] = 40 << 16;
    static_cast<void>(bench.feed(3, {more})); // which ends with a velocity
    bench.wait_us(14000);
    CHECK(bench.drive.machine().rate() == 1.0);
    bench.wait_us(1000);
    CHECK(bench.status().executed == 3);
    CHECK(bench.drive.position_counts(0) == Approx(30.0).margin(1e-9));
    bench.wait_us(1);
    CHECK(bench.drive.machine().rate() == Approx(std::sqrt(0.01 / reserve_s)).margin(1e-4));
    bench.wait_us(1'000'000);
    CHECK(bench.state() == PvtState::held);
    CHECK(bench.drive.position_counts(0) == 40.0);
}

TEST_CASE("PVT drive: watchdog, a hold that says so", "[drive][pvt]") {
    PvtBench bench(1);
    bench.begin();
    REQUIRE(bench.drive.write(0x0010, std::array<std::uint16_t, 1>{50}) == ModbusException::none);
    static_cast<void>(bench.feed(0, steady(1, 5, 8'000'000, 1000.0)));
    bench.wait_us(1'000'000); // standing, it may wait for ever
    CHECK(bench.state() == PvtState::standing);
    CHECK(bench.command(PvtCommand::start, bench.status().clock_us - 50'000).refused ==
          PvtRefusal::state); // too late to be watched
    CHECK(bench.state() == PvtState::standing);
    CHECK(bench.command(PvtCommand::start, bench.status().clock_us - 49'999).refused == PvtRefusal::none);
    for (int i = 0; i < 10; ++i) {
        bench.wait_us(40000);
        CHECK(bench.feed(5, {}).state == PvtState::running);
    }
    // Frames that are none do not count.
    bench.wait_us(30000);
    CHECK(bench.send({.session = 5}).state == PvtState::running);
    bench.wait_us(19999);
    CHECK(bench.state() == PvtState::running);
    bench.wait_us(1);
    CHECK(bench.state() == PvtState::stopping);
    CHECK(bench.status().fault == static_cast<std::uint16_t>(PvtFault::watchdog));
    const double at = bench.drive.position_counts(0);
    bench.wait_us(200001);
    CHECK(bench.state() == PvtState::held);
    // S of the way, here in the first segment of 1 s: q = 3 u^2 ... from rest to 1000 counts/s
    CHECK(bench.drive.position_counts(0) ==
          Approx(static_cast<double>(hermite(steady(1, 1, 8'000'000, 1000.0), 0, 0.55L * 8e6L))));
    CHECK(bench.drive.position_counts(0) > at);
    CHECK(bench.command(PvtCommand::resume, bench.status().clock_us).state == PvtState::running);
    CHECK(bench.status().fault == 0);
}

TEST_CASE("PVT drive: a ring is not cut where it could not stop on the path", "[drive][pvt]") {
    PvtBench bench(2);
    bench.begin();
    static_cast<void>(bench.feed(0, steady(2, 4, 800000, 1000.0)));
    bench.start_now();
    bench.wait_us(150000); // half of the second segment; R = 50 ms to its end, S = 100 ms
    CHECK(bench.command(PvtCommand::end, 1).refused == PvtRefusal::state);
    CHECK(bench.command(PvtCommand::end, 2).refused == PvtRefusal::state);
    CHECK(bench.status().next == 4);
    const PvtStatus status = bench.command(PvtCommand::end, 3);
    CHECK(status.refused == PvtRefusal::none);
    CHECK(status.next == 3);
    bench.wait_us(300000);
    CHECK(bench.state() == PvtState::held);
    CHECK(bench.status().executed == 3);
    CHECK(bench.status().fault == 0);
}

TEST_CASE("PVT drive: following error and limits trip, with their axis", "[drive][pvt]") {
    PvtBench bench(3);
    REQUIRE(bench.drive.write(0x0012, std::array<std::uint16_t, 2>{0, 2}) == ModbusException::none);
    bench.begin();
    bench.drive.machine().shaft(1).disturb(1e5); // bends it by 0.7 counts
    bench.wait_us(100000);
    CHECK(bench.state() == PvtState::standing);
    CHECK(bench.status().following_error[1] == Approx(0.7036 * 65536).epsilon(1e-3));
    bench.drive.machine().shaft(1).disturb(4e5);
    bench.wait_us(100000);
    CHECK(bench.state() == PvtState::fault);
    CHECK(bench.status().fault == static_cast<std::uint16_t>(PvtFault::following_error));
    CHECK(bench.status().fault_axis == 1);

    for (const bool velocity : {true, false}) {
        PvtDriveParameters parameters;
        parameters.axes.front().largest_counts_s = velocity ? 2999.0 : 3001.0;
        // 0 to 3000 counts/s in 0.1 s, by q = 2 u^2 - u^3 of the way: at most 4 v / T
        parameters.axes.front().largest_counts_s2 = velocity ? 0.0 : 3000.0 * 4.0 / 0.1 * 0.99;
        PvtBench limited(3, parameters);
        limited.begin();
        static_cast<void>(limited.feed(0, steady(3, 2, 800000, 1000.0)));
        limited.start_now();
        limited.wait_us(300000);
        CHECK(limited.state() == PvtState::fault);
        CHECK(limited.status().fault == static_cast<std::uint16_t>(PvtFault::limit));
        CHECK(limited.status().fault_axis == 2);
    }
}
