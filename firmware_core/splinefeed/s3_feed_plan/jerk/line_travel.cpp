// SPDX-License-Identifier: MIT
#include "splinefeed/s3_feed_plan/jerk/line_travel.hpp"

#include "splinefeed/number/scalar.hpp"

namespace splinefeed {

namespace {

constexpr double nothing_s = 1e-12; // shorter phases, and rounding of one, count as zero
constexpr double nothing_mm = 1e-12;

} // namespace

// The time after which a length is travelled, within a phase. The distance grows with time, so bisection would find it;
// Newton's method is faster.
double LineTravel::time_to(double length_mm, double longest_s, double jerk_mm_s3) const noexcept {
    double low = 0.0;
    double high = longest_s;
    double t = 0.5 * high;
    for (int i = 0; i < 60; ++i) {
        const MoveState there = state_.after(t, jerk_mm_s3);
        const double beyond = there.position_mm - length_mm;
        (beyond > 0.0 ? high : low) = t;
        const double step = there.speed_mm_s > 0.0 ? t - beyond / there.speed_mm_s : low;
        const double next = step > low && step < high ? step : 0.5 * (low + high);
        if (absolute(next - t) <= 1e-15 * longest_s) {
            break;
        }
        t = next;
    }
    return t;
}

LinePiece LineTravel::next(double at_most_mm) noexcept {
    while (phase_ + 1 < SCurveProfile::phases && move_.phase(phase_).duration_s - in_phase_s_ <= nothing_s) {
        ++phase_;
        in_phase_s_ = 0.0;
    }
    const JerkPhase& phase = move_.phase(phase_);
    double duration = phase.duration_s - in_phase_s_;
    MoveState there = state_.after(duration, phase.jerk_mm_s3);
    const bool to_end = there.position_mm <= at_most_mm + nothing_mm;
    if (to_end) {
        ++phase_;
        in_phase_s_ = 0.0;
    } else {
        duration = time_to(at_most_mm, duration, phase.jerk_mm_s3);
        there = state_.after(duration, phase.jerk_mm_s3);
        in_phase_s_ += duration;
    }
    LinePiece piece;
    piece.length_mm = to_end ? smaller(there.position_mm, at_most_mm) : at_most_mm;
    piece.duration_s = duration;
    const double per_length = there.position_mm > 0.0 ? 1.0 / there.position_mm : 0.0;
    piece.linear = state_.speed_mm_s * duration * per_length;
    piece.quadratic = 0.5 * state_.acceleration_mm_s2 * duration * duration * per_length;
    piece.entry_mm_s = state_.speed_mm_s;
    piece.exit_mm_s = larger(there.speed_mm_s, 0.0);
    state_ = {0.0, piece.exit_mm_s, there.acceleration_mm_s2};
    return piece;
}

LinePiece LineTravel::next() noexcept {
    return next(largest<double>());
}

} // namespace splinefeed
