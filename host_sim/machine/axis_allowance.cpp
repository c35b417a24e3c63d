// SPDX-License-Identifier: MIT
//
// Tolerance. A control point of the stream is a position rounded to 2^-fraction_bits mm, then to a multiple of 6 units:
// it is off by at most
//
//   e = 2^-(fraction_bits + 1) mm + 3 units.
//
// Velocity, acceleration and jerk of the segment are its first, second, third differences over T, T^2, T^3, hence off
// by at most e / T (the average of two first differences), 4 e / T^2 and 8 e / T^3. For 1000 counts per mm, e is 1.4
// pm, and 4 e / T^2 at 1 ms is 6e-9 of 1000 mm/s^2. The further 1e-6 is for the rounding of the curve itself.
#include "host_sim/machine/axis_allowance.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::host {

namespace {

constexpr double tolerance = 1e-6;

} // namespace

Allowance::Allowance(double limit_, double noise_) noexcept
    : limit(limit_), most(limit_ * (1.0 + tolerance)), noise(noise_) {}

AxisAllowance::AxisAllowance(const AxisSettings& settings, const std::optional<Travel>& travel_) noexcept
    : units_per_mm(static_cast<double>(units_per_count) * settings.steps_per_mm), travel(travel_),
      rotary(settings.rotary) {
    const double e = std::ldexp(1.0, -(Position::fraction_bits + 1)) + 3.0 / units_per_mm;
    velocity = Allowance(settings.max_velocity_mm_s, e);
    acceleration = Allowance(settings.max_acceleration_mm_s2, 4.0 * e);
    braking = Allowance(settings.braking_mm_s2(), 4.0 * e);
    brakes_differently = braking.limit != acceleration.limit;
    jerk = Allowance(settings.max_jerk_mm_s3, 8.0 * e);
    if (travel) {
        const double play = tolerance * (travel->high - travel->low) + e;
        lowest = travel->low - play;
        highest = travel->high + play;
        end_velocity = Allowance(settings.travel_end_velocity_mm_s, e);
        open_low = travel->low + settings.travel_end_zone_mm;
        open_high = travel->high - settings.travel_end_zone_mm;
    }
}

// Where one limit holds for both, signs do not matter: acceleration is linear, its largest at an end.
Accelerations AxisAllowance::accelerations(const SegmentCubic& cubic, double from, double to) const noexcept {
    if (brakes_differently) {
        return cubic.accelerations(from, to);
    }
    return {std::max(std::fabs(cubic.acceleration(from)), std::fabs(cubic.acceleration(to))), 0.0};
}

} // namespace splinefeed::host
