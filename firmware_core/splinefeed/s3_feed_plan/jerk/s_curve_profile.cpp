// SPDX-License-Identifier: MIT
//
// From standstill to the speed v, with the jerk j and at most the acceleration a:
//   v j >= a^2: the acceleration rises for a/j, stays for v/a - a/j and falls for a/j: T = v/a + a/j in all,
//   otherwise it rises and falls for sqrt(v/j) each: T = 2 sqrt(v/j).
// By symmetry the distance is v T / 2, and as much for braking. If 2 v T / 2 > L, the speed v that is reached follows
// from v T(v) = L: v^2/a + v a/j = L, or 2 v^(3/2) / sqrt(j) = L.
//
// In motion, with the acceleration b (positive towards the wanted speed, a change by d): the acceleration goes from b
// to a peak p and back to zero, which changes the speed by (2 p^2 - b^2) / (2 j); p = sqrt(j d + b^2 / 2), or the
// limit, which then stays for a while. The distance of a move to standstill grows with its peak speed, which is found
// by bisection.
#include "splinefeed/s3_feed_plan/jerk/s_curve_profile.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/scalar.hpp"

namespace splinefeed {

namespace {

constexpr double length_rounding = 1e-9; // of a length, which would be travelled very slowly

} // namespace

// Newton's method on y^3 = x^2, after powers of 8 are removed from x: y starts within a factor of 2.
template <Floating R>
R power_two_thirds(R x) noexcept {
    if (!(x <= largest<R>())) {
        return x; // no power of 8 brings infinity down
    }
    R scale{1};
    while (x >= R(8)) {
        x *= R(0.125);
        scale *= R(4);
    }
    while (x < R(1) && x > R(0)) {
        x *= R(8);
        scale *= R(0.25);
    }
    R y{2};
    for (int i = 0; i < 8; ++i) {
        y = (R(2) * y + x * x / (y * y)) * R(1.0 / 3.0);
    }
    return y * scale;
}

#define SPLINEFEED_INSTANTIATE(R) template R power_two_thirds(R) noexcept;
SPLINEFEED_EACH_JERK_REAL(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

MoveState MoveState::after(double t, double jerk_mm_s3) const noexcept {
    return {position_mm + t * (speed_mm_s + t * (0.5 * acceleration_mm_s2 + t * jerk_mm_s3 * (1.0 / 6.0))),
            speed_mm_s + t * (acceleration_mm_s2 + 0.5 * t * jerk_mm_s3), acceleration_mm_s2 + t * jerk_mm_s3};
}

SCurveProfile::SCurveProfile(double length_mm, const MoveLimits& limits) noexcept {
    const double a = limits.acceleration_mm_s2;
    const double j = limits.jerk_mm_s3;
    const double corner = a * a / j; // up to this speed the acceleration does not reach its limit
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

// To a steady speed, in three phases.
void SCurveProfile::ramp(std::size_t first, const MoveState& from, double to_mm_s, const MoveLimits& limits) noexcept {
    const double j = limits.jerk_mm_s3;
    const double a0 = from.acceleration_mm_s2;
    const double steady = from.speed_mm_s + 0.5 * a0 * absolute(a0) / j; // the speed if the acceleration falls to zero
                                                                         // at once
    const double way = to_mm_s < steady ? -1.0 : 1.0;
    const double b = way * a0;
    const double change = way * (to_mm_s - from.speed_mm_s);
    const double square = j * change + 0.5 * b * b;
    double peak = square > 0.0 ? square_root(square) : 0.0;
    double stay = 0.0;
    const double most = larger(limits.acceleration_mm_s2, b); // rounding, or a limit that was lowered
    if (peak > most) {
        peak = most;
        stay = larger((change - (2.0 * peak * peak - b * b) / (2.0 * j)) / peak, 0.0);
    }
    phase_[first] = {larger((peak - b) / j, 0.0), way * j};
    phase_[first + 1] = {stay, 0.0};
    phase_[first + 2] = {peak / j, -way * j};
}

void SCurveProfile::pass(const MoveState& start, double peak_mm_s, const MoveLimits& limits) noexcept {
    start_ = start;
    ramp(0, start, peak_mm_s, limits);
    phase_[3] = {};
    ramp(4, {0.0, peak_mm_s, 0.0}, 0.0, limits);
}

SCurveProfile SCurveProfile::to_rest(const MoveState& start, const MoveLimits& limits) noexcept {
    SCurveProfile move;
    move.start_ = start;
    move.ramp(4, start, 0.0, limits); // the last phases, with which a move ends
    return move;
}

SCurveProfile SCurveProfile::to_length(const MoveState& start, double length_mm, const MoveLimits& limits) noexcept {
    SCurveProfile nearest = to_rest(start, limits);
    if (!(nearest.length_mm() < length_mm * (1.0 - length_rounding))) {
        return nearest;
    }
    SCurveProfile move;
    move.pass(start, limits.speed_mm_s, limits);
    const double rest = length_mm - move.length_mm();
    if (rest >= 0.0) {
        move.phase_[3].duration_s = rest / limits.speed_mm_s;
        return move;
    }
    double low = 0.0;
    double high = limits.speed_mm_s;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        move.pass(start, middle, limits);
        (move.length_mm() > length_mm ? high : low) = middle;
    }
    move.pass(start, low, limits);
    if (low > 0.0) {
        move.phase_[3].duration_s = larger((length_mm - move.length_mm()) / low, 0.0); // the rest that bisection left
    }
    return move;
}

double SCurveProfile::length_mm() const noexcept {
    MoveState state{0.0, start_.speed_mm_s, start_.acceleration_mm_s2};
    for (const JerkPhase& phase : phase_) {
        state = state.after(phase.duration_s, phase.jerk_mm_s3);
    }
    return state.position_mm;
}

double SCurveProfile::duration_s() const noexcept {
    double sum = 0.0;
    for (const JerkPhase& phase : phase_) {
        sum += phase.duration_s;
    }
    return sum;
}

} // namespace splinefeed
