// SPDX-License-Identifier: MIT
//
// To the speed v with the jerk j and at most the acceleration a:
//   v j >= a^2: the acceleration rises for a/j, stays for v/a - a/j and falls for a/j: T = v/a + a/j in all,
//   else it rises and falls for sqrt(v/j): T = 2 sqrt(v/j).
// By symmetry the way is v T / 2, and as much for braking. Where 2 v T / 2 > L, the speed v that is reached follows
// from v T(v) = L: v^2/a + v a/j = L, or 2 v^(3/2) / sqrt(j) = L.
#include "splinefeed/s3_feed_plan/straight_move.hpp"

#include "splinefeed/number/scalar.hpp"

namespace splinefeed {

// Newton's method on y^3 = x^2 from above, after taking powers of 8 out of x^2 so that y starts within a factor of 4.
double power_two_thirds(double x) noexcept {
    double square = x * x;
    double scale = 1.0;
    while (square > 8.0) {
        square *= 0.125;
        scale *= 2.0;
    }
    while (square < 1.0 && square > 0.0) {
        square *= 8.0;
        scale *= 0.5;
    }
    double y = 2.0;
    for (int i = 0; i < 8; ++i) {
        y = (2.0 * y + square / (y * y)) * (1.0 / 3.0);
    }
    return y * scale;
}

MoveState MoveState::after(double t, double jerk_mm_s3) const noexcept {
    return {position_mm + t * (speed_mm_s + t * (0.5 * acceleration_mm_s2 + t * jerk_mm_s3 * (1.0 / 6.0))),
            speed_mm_s + t * (acceleration_mm_s2 + 0.5 * t * jerk_mm_s3), acceleration_mm_s2 + t * jerk_mm_s3};
}

StraightMove::StraightMove(double length_mm, const MoveLimits& limits) noexcept {
    const double a = limits.acceleration_mm_s2;
    const double j = limits.jerk_mm_s3;
    const double corner = a * a / j; // speed up to which the acceleration does not reach its limit
    double v = limits.speed_mm_s;
    const double ramp = v >= corner ? v / a + a / j : 2.0 * square_root(v / j);
    double cruise = 0.0;
    if (v * ramp <= length_mm) {
        cruise = (length_mm - v * ramp) / v;
    } else {
        v = power_two_thirds(0.5 * length_mm * square_root(j));
        if (v > corner) {
            v = 0.5 * (square_root(corner * corner + 4.0 * a * length_mm) - corner);
        }
    }
    const double rise = v >= corner ? a / j : square_root(v / j);
    const double stay = v >= corner ? larger(v / a - a / j, 0.0) : 0.0;
    phase_ = {{{rise, j}, {stay, 0.0}, {rise, -j}, {cruise, 0.0}, {rise, -j}, {stay, 0.0}, {rise, j}}};
}

double StraightMove::duration_s() const noexcept {
    double sum = 0.0;
    for (const JerkPhase& phase : phase_) {
        sum += phase.duration_s;
    }
    return sum;
}

} // namespace splinefeed
