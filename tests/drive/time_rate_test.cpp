// SPDX-License-Identifier: MIT
#include "host_sim/drive/time_rate.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <random>

using namespace splinefeed::host;

namespace {

constexpr double reserve = 0.1;

/// One segment that is as long as the ring; passes time in pieces.
struct Ring {
    TimeRate rate;
    double left = 0.0;

    double pass(double time_s, bool ends_moving, bool holds = false) {
        const TimeRate::Passed passed =
            rate.pass(time_s, {.ring_s = left, .segment_s = left, .ends_moving = ends_moving, .holds = holds});
        left = passed.at_end ? 0.0 : left - passed.way_s;
        return passed.time_s;
    }
};

Ring ring_of(double length) {
    Ring ring;
    ring.rate.set_stop_reserve(reserve);
    ring.left = length;
    return ring;
}

} // namespace

TEST_CASE("time rate: min(1, sqrt(R / S)) to the end of the ring, in 2 S", "[drive][time_rate]") {
    Ring ring = ring_of(0.5);
    ring.rate.start({.ring_s = 0.5, .segment_s = 0.5, .ends_moving = true, .holds = false});
    CHECK(ring.rate.rate() == 1.0);
    double time = 0.0;
    while (ring.left > 0.0) {
        time += ring.pass(0.00037, true);
        if (ring.left > 1e-9) {
            REQUIRE(ring.rate.rate() == Approx(std::min(1.0, std::sqrt(ring.left / reserve))).margin(1e-9));
        }
        REQUIRE(time < 1.0);
    }
    CHECK(time == Approx(0.4 + 2.0 * reserve).margin(1e-7));
    CHECK(ring.rate.rate() < 1e-6);
}

TEST_CASE("time rate: a complete motion goes on at full rate, a rise takes 2 S", "[drive][time_rate]") {
    Ring ring = ring_of(0.05);
    ring.rate.start({.ring_s = 0.05, .segment_s = 0.05, .ends_moving = false, .holds = false});
    CHECK(ring.pass(1.0, false) == Approx(0.05));
    CHECK(ring.left == 0.0);
    CHECK(ring.rate.rate() == 1.0);

    ring = ring_of(0.05);
    ring.rate.start({.ring_s = 0.05, .segment_s = 0.05, .ends_moving = true, .holds = false});
    CHECK(ring.rate.rate() == Approx(std::sqrt(0.5)));
    ring.left += 1.0; // segments have come in
    CHECK(ring.pass(0.02, true) == Approx(0.02));
    CHECK(ring.rate.rate() == Approx(std::sqrt(0.5) + 0.02 / (2.0 * reserve)));
    static_cast<void>(ring.pass(0.2, true));
    CHECK(ring.rate.rate() == 1.0);
}

TEST_CASE("time rate: a hold stands after 2 S and S of the way, and not beyond the end of the ring",
          "[drive][time_rate]") {
    for (const double length : {3.0, 0.3, 0.1, 0.02}) {
        CAPTURE(length);
        Ring ring = ring_of(length);
        ring.rate.start({.ring_s = length, .segment_s = length, .ends_moving = true, .holds = false});
        const double at_first = ring.rate.rate();
        double time = 0.0;
        for (int i = 0; i < 1000; ++i) {
            time += ring.pass(0.001, true, true);
        }
        CHECK(ring.rate.rate() == Approx(0.0).margin(1e-6));
        CHECK(length - ring.left == Approx(at_first * at_first * reserve).margin(1e-9));
        CHECK(time == Approx(2.0 * reserve * at_first).margin(1e-6));
    }
}

TEST_CASE("time rate: how time is cut does not matter, and the slope is kept", "[drive][time_rate]") {
    const auto seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    const auto uniform = [&] {
        return static_cast<double>(random() >> 11U) * 0x1p-53;
    };
    for (int round = 0; round < 200; ++round) {
        Ring once = ring_of(0.01 + 0.5 * uniform());
        once.rate.start({.ring_s = once.left, .segment_s = once.left, .ends_moving = true, .holds = false});
        Ring often = once;
        for (int act = 0; act < 6; ++act) {
            const double more = uniform() < 0.5 ? 0.3 * uniform() : 0.0;
            const bool moving = uniform() < 0.8;
            const bool holds = uniform() < 0.3;
            const double time = 0.2 * uniform();
            once.left += more;
            often.left += more;
            // A motion that was complete and goes on starts where it stands; here it has not come there.
            for (Ring* ring : {&once, &often}) {
                if (moving) {
                    ring->rate.pass_rest(
                        {.ring_s = ring->left, .segment_s = ring->left, .ends_moving = true, .holds = holds});
                }
            }
            static_cast<void>(once.pass(time, moving, holds));
            const int parts = 1 + static_cast<int>(uniform() * 60.0);
            for (int part = 0; part < parts; ++part) {
                const double before = often.rate.rate();
                const double passed = often.pass(time / parts, moving, holds);
                REQUIRE(std::fabs(often.rate.rate() - before) <= passed / (2.0 * reserve) + 1e-6);
            }
            REQUIRE(often.left == Approx(once.left).margin(1e-10));
            REQUIRE(often.rate.rate() == Approx(once.rate.rate()).margin(1e-5));
        }
    }
}

TEST_CASE("time rate: where the ring was cut too short it arrives with the rate that is left", "[drive][time_rate]") {
    Ring ring = ring_of(0.5);
    ring.rate.start({.ring_s = 0.5, .segment_s = 0.5, .ends_moving = true, .holds = false});
    ring.left = 0.5 * reserve;
    while (ring.left > 0.0) {
        REQUIRE(ring.pass(0.001, true) > 0.0);
    }
    // sigma^2 = 1 - R / S
    CHECK(ring.rate.rate() == Approx(std::sqrt(0.5)));
}
