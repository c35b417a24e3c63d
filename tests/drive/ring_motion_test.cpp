// SPDX-License-Identifier: MIT
#include "host_sim/drive/ring_motion.hpp"
#include "support/catch.hpp"

#include <array>

using namespace splinefeed::host;
using splinefeed::hal::modbus::PvtRefusal;
using splinefeed::hal::modbus::PvtSegment;
using Outcome = RingMotion::Outcome;

TEST_CASE("ring motion: without a place to stand it slows down to the end of the ring", "[drive][ring_motion]") {
    PvtReference reference;
    reference.counts[0] = 5.0;
    RingMotion motion(1, 16);
    motion.set_stop_reserve(0.01);
    motion.begin(7, reference);
    std::array<PvtSegment, 2> ring; // to 100 counts/s in the first tenth of a second, and keeps it
    for (PvtSegment& segment : ring) {
        segment.duration_ticks = 800'000;
        segment.end[0] = (&segment == ring.data() ? 15 : 25) << 16;
        segment.end_velocity[0] = 10 << 24;
    }
    REQUIRE(motion.ring().take(7, ring) == PvtRefusal::none);
    motion.start();
    std::uint64_t now_us = 1'000'000;
    CHECK(motion.pass(now_us, 0.2, reference) == Outcome::moves);
    CHECK(motion.rate() == Approx(0.5)); // S before the end of 2 S
    CHECK(reference.counts_s[0] == Approx(50.0));
    Outcome outcome = Outcome::moves;
    for (now_us += 200'000; outcome == Outcome::moves && now_us < 2'000'000; now_us += 125) {
        outcome = motion.pass(now_us, 125e-6, reference);
    }
    CHECK(outcome == Outcome::held);
    CHECK(static_cast<double>(now_us) == Approx(1'210'000.0).margin(130.0));
    CHECK(reference.counts[0] == 25.0);
    motion.begin(7, {});
    REQUIRE(motion.ring().take(7, ring) == PvtRefusal::none);
    motion.start();
    CHECK(motion.pass(now_us, 0.1, reference) == Outcome::moves);
    motion.ring().begin(8, {}); // taken away while it moves
    CHECK(motion.pass(now_us + 100'000, 0.001, reference) == Outcome::underflow);
}
