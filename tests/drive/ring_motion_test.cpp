// SPDX-License-Identifier: MIT
#include "host_sim/drive/ring_motion.hpp"
#include "support/catch.hpp"

#include <vector>

using namespace splinefeed::host;
using splinefeed::hal::modbus::PvtRefusal;
using splinefeed::hal::modbus::PvtSegment;
using Outcome = RingMotion::Outcome;

namespace {

constexpr double reserve_s = 0.01;

/// A motion of one axis that speeds up to 100 counts/s in the first tenth of a second and keeps it.
struct Bench {
    explicit Bench(int segments, bool rest = false) {
        PvtReference here;
        here.counts[0] = 5.0;
        motion.observe([this](const ExecutedSegment& segment) { executed.push_back(segment); });
        motion.set_stop_reserve(reserve_s);
        motion.begin(7, here);
        std::vector<PvtSegment> ring(static_cast<std::size_t>(segments));
        for (std::size_t i = 0; i < ring.size(); ++i) {
            ring[i].duration_ticks = 800'000;
            ring[i].end[0] = (5 + 10 * (static_cast<std::int64_t>(i) + 1)) << 16;
            ring[i].end_velocity[0] = 10 << 24;
        }
        if (rest) {
            ring.back().rest = true;
            ring.back().end_velocity[0] = 0;
        }
        REQUIRE(motion.ring().take(7, ring) == PvtRefusal::none);
        reference = here;
    }
    Outcome pass(double duration_s) {
        const Outcome outcome = motion.pass(now_us, duration_s, reference);
        now_us += static_cast<std::uint64_t>(duration_s * 1e6);
        return outcome;
    }

    std::vector<ExecutedSegment> executed;
    RingMotion motion{1, 16};
    PvtReference reference;
    std::uint64_t now_us = 1'000'000;
};

} // namespace

TEST_CASE("ring motion: a complete motion ends at full rate, exactly there and then", "[drive][ring_motion]") {
    Bench bench(3, true);
    bench.motion.start();
    CHECK(bench.motion.rate() == 1.0);
    CHECK(bench.pass(0.15) == Outcome::moves);
    REQUIRE(bench.executed.size() == 1);
    CHECK(bench.executed[0].sequence == 7);
    CHECK(bench.executed[0].end_us == Approx(1'100'000.0).margin(1e-3));
    CHECK(bench.reference.counts[0] == Approx(20.0).margin(1e-9));
    CHECK(bench.reference.counts_s[0] == Approx(100.0));
    CHECK(bench.pass(0.2) == Outcome::complete); // two ends in one call
    REQUIRE(bench.executed.size() == 3);
    CHECK(bench.executed[2].end_us == Approx(1'300'000.0).margin(1e-3));
    CHECK(bench.reference.counts[0] == 35.0);
    CHECK(bench.reference.rests());
}

TEST_CASE("ring motion: without a place to stand it slows down to the end of the ring", "[drive][ring_motion]") {
    Bench bench(2);
    bench.motion.start();
    CHECK(bench.pass(0.2) == Outcome::moves);
    CHECK(bench.motion.rate() == Approx(0.5)); // S before the end of 2 S
    CHECK(bench.reference.counts_s[0] == Approx(50.0));
    Outcome outcome = Outcome::moves;
    while (outcome == Outcome::moves && bench.now_us < 2'000'000) {
        outcome = bench.pass(125e-6);
    }
    CHECK(outcome == Outcome::held);
    CHECK(static_cast<double>(bench.now_us) == Approx(1'210'000.0).margin(130.0));
    CHECK(bench.reference.counts[0] == 25.0);
}

TEST_CASE("ring motion: a hold rests on the path, and it goes on from there", "[drive][ring_motion]") {
    Bench bench(3);
    bench.motion.start();
    CHECK(bench.pass(0.15) == Outcome::moves);
    bench.motion.hold();
    CHECK(bench.pass(reserve_s) == Outcome::moves);
    CHECK(bench.motion.rate() == Approx(0.5));
    CHECK(bench.pass(0.1) == Outcome::held);
    CHECK(bench.reference.counts[0] == Approx(20.0 + 100.0 * reserve_s)); // S of the way
    CHECK(bench.reference.rests());
    CHECK(bench.motion.rate() == 0.0);
    bench.motion.leave();
    bench.motion.resume();
    CHECK(bench.pass(2 * reserve_s) == Outcome::moves);
    CHECK(bench.reference.counts[0] == Approx(20.0 + 200.0 * reserve_s));
    CHECK(bench.motion.rate() == Approx(1.0));
}

TEST_CASE("ring motion: it ends early only where it can stop; else it would be an underflow", "[drive][ring_motion]") {
    Bench bench(4);
    bench.motion.start();
    CHECK(bench.pass(0.195) == Outcome::moves);
    CHECK_FALSE(bench.motion.end_before(9)); // 5 ms away, and S are 10
    CHECK(bench.motion.ring().next() == 11);
    CHECK(bench.motion.end_before(10));
    CHECK(bench.motion.ring().next() == 10);
    // Taken away unasked, while it moves.
    bench.motion.ring().begin(9, {});
    CHECK(bench.pass(0.001) == Outcome::underflow);
}

TEST_CASE("ring motion: at the end of nothing it is held where no axis moves", "[drive][ring_motion]") {
    Bench bench(1);
    bench.motion.start();
    bench.motion.ring().begin(7, {});
    CHECK(bench.pass(0.001) == Outcome::held);
    CHECK(bench.executed.empty());
}
