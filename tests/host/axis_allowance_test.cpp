// SPDX-License-Identifier: MIT
//
// What the simulated machine grants beyond a limit, against the rounding of control points as the stream makes it.
#include "host_sim/machine/axis_allowance.hpp"

#include "support/catch.hpp"

#include <cmath>

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

AxisSettings settings_of(double steps_per_mm) {
    AxisSettings settings;
    settings.max_velocity_mm_s = 100.0;
    settings.max_acceleration_mm_s2 = 1000.0;
    settings.max_jerk_mm_s3 = 20000.0;
    settings.steps_per_mm = steps_per_mm;
    return settings;
}

FeedSegment segment_of(std::int64_t end, std::int64_t start_velocity, std::int64_t end_velocity) {
    FeedSegment segment{};
    segment.duration_ticks = 8000;
    segment.end[0] = end;
    segment.start_velocity[0] = start_velocity;
    segment.end_velocity[0] = end_velocity;
    return segment;
}

} // namespace

TEST_CASE("the allowance is a millionth of the limit and what rounds control points") {
    for (const double steps_per_mm : {10.0, 1000.0, 1e6}) {
        CAPTURE(steps_per_mm);
        const AxisAllowance axis(settings_of(steps_per_mm), std::nullopt);
        CHECK(axis.velocity.limit == 100.0);
        CHECK(axis.velocity.most == Approx(100.0 * (1.0 + 1e-6)).epsilon(1e-12));
        CHECK(axis.acceleration.most == Approx(1000.0 * (1.0 + 1e-6)).epsilon(1e-12));
        CHECK(axis.jerk.most == Approx(20000.0 * (1.0 + 1e-6)).epsilon(1e-12));
        // Half of a multiple of 6 units, and half of the last digit of a position
        const double e = 3.0 / axis.units_per_mm + std::ldexp(0.5, -Position::fraction_bits);
        CHECK(axis.velocity.noise == Approx(e).epsilon(1e-12));
        CHECK(axis.acceleration.noise == Approx(4.0 * e).epsilon(1e-12));
        CHECK(axis.jerk.noise == Approx(8.0 * e).epsilon(1e-12));
        CHECK_FALSE(axis.brakes_differently);
        CHECK_FALSE(axis.travel.has_value());
    }
}

TEST_CASE("travel and its end zones") {
    AxisSettings settings = settings_of(1000.0);
    settings.travel_end_zone_mm = 5.0;
    settings.travel_end_velocity_mm_s = 20.0;
    const AxisAllowance axis(settings, splinefeed::host::Travel{-10.0, 90.0});
    CHECK(axis.lowest == Approx(-10.0 - 1e-4).epsilon(1e-8));
    CHECK(axis.highest == Approx(90.0 + 1e-4).epsilon(1e-8));
    CHECK(axis.open_low == -5.0);
    CHECK(axis.open_high == 85.0);
    CHECK(axis.end_velocity.limit == 20.0);
}

TEST_CASE("accelerations are told apart where braking has a limit of its own") {
    AxisSettings settings = settings_of(1000.0);
    const AxisAllowance alike(settings, std::nullopt);
    settings.max_braking_mm_s2 = 500.0;
    const AxisAllowance apart(settings, std::nullopt);
    CHECK(apart.brakes_differently);
    // Forward, from fast to slow with constant acceleration
    const auto units = static_cast<std::int64_t>(apart.units_per_mm * 0.1);
    const SegmentCubic braking(segment_of(units, 3 * units / 2, units / 2), 0, apart.units_per_mm, 1e-3);
    const double a = 0.1 / 1e-6;
    CHECK(alike.accelerations(braking, 0.0, 1.0).speeding == Approx(a));
    CHECK(alike.accelerations(braking, 0.0, 1.0).braking == 0.0);
    CHECK(apart.accelerations(braking, 0.0, 1.0).speeding == 0.0);
    CHECK(apart.accelerations(braking, 0.0, 1.0).braking == Approx(a));
}
