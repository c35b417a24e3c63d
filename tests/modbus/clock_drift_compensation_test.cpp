// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/pvt/clock_drift_compensation.hpp"

#include "support/catch.hpp"

#include <cmath>

using splinefeed::hal::modbus::ClockDriftCompensation;

TEST_CASE("Duration trim: a drive whose clock is fast or slow stays in step for an hour") {
    constexpr std::uint32_t ticks = 8000;
    for (const double skew_ppm : {0.0, 150.0, -90.0, 240.0}) {
        INFO("skew " << skew_ppm << " ppm");
        ClockDriftCompensation trim;
        trim.anchor(1e6);
        double drive_end_us = 1e6; // by the drive's clock
        double largest = 0.0;
        std::uint32_t longest = 0;
        std::uint32_t shortest = ticks;
        for (int i = 0; i < 3'600'000; ++i) {
            const double end_us = trim.next_end_us(ticks);
            const std::uint32_t corrected = trim.trimmed(ticks, 1e-6 * skew_ppm * (end_us - 1e6));
            longest = corrected > longest ? corrected : longest;
            shortest = corrected < shortest ? corrected : shortest;
            drive_end_us += corrected / 8.0;
            largest = std::fmax(largest, std::fabs(drive_end_us - (end_us + 1e-6 * skew_ppm * (end_us - 1e6))));
        }
        CHECK(largest < ClockDriftCompensation::tolerated_us + 0.2);
        CHECK(longest <= ticks + 2);
        CHECK(shortest >= ticks - 2);
    }
}

TEST_CASE("Duration trim: a jump of the estimate is taken up gently") {
    ClockDriftCompensation trim;
    CHECK_FALSE(trim.anchored());
    trim.anchor(0.0);
    CHECK(trim.anchored());
    double gained = 0.0;
    for (int i = 0; i < 2000; ++i) {
        const std::uint32_t corrected = trim.trimmed(8000, 40.0);
        CHECK(corrected <= 8002);
        gained += (corrected - 8000.0) / 8.0;
    }
    CHECK(std::fabs(gained - 40.0) <= 3.0);
    for (int i = 0; i < 100; ++i) { // what moves little is left alone
        CHECK(trim.trimmed(8000, 40.0 + (i % 2 == 0 ? 9.0 : -9.0)) == 8000);
    }
}
