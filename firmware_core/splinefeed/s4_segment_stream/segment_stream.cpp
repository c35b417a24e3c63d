// SPDX-License-Identifier: MIT
//
// With samples c_k = q(k T) as control points, the emitted curve over segment k runs from
//
//   p = (c_{k-1} + 4 c_k + c_{k+1}) / 6   with velocity   (c_{k+1} - c_{k-1}) / (2 T)   and acceleration
//   (c_{k+1} - 2 c_k + c_{k-1}) / T^2     to the same of k+1,
//
// its acceleration linear in between. A first, second or third difference of samples over T, T^2, T^3 is an average of
// q', q'' or q''' over the samples' span, hence inside any limit that the plan keeps. p differs from c_k by a sixth of
// a second difference: at most T^2 |A| / 6.
//
// Control points are rounded to multiples of 6 units; then p and 3 (c_{k+1} - c_{k-1}), the velocity in units per
// segment, are whole numbers and the chain is C2 in exact arithmetic. Nothing accumulates: every control point is
// rounded from an absolute position.
//
// At a stop the control point is repeated three times: position exact, velocity and acceleration zero at one instant.
// The dwell is 2 T and what is left of the current T.
#include "splinefeed/s4_segment_stream/segment_stream.hpp"

namespace splinefeed {

namespace {

// Arriving up to this fraction of a segment early counts as arriving: an exact multiple of the segment duration must
// not be decided by rounding. The control point moves by A (T/1024)^2 / 2, a 2e-6 part of a second difference.
constexpr double arrival = 1.0 / 1024.0;

// From 2^-40 mm times Q32.32 counts per mm to multiples of 6 units: 6 units are 2^-29 counts.
constexpr int control_shift = Position::fraction_bits + 32 - 29;

} // namespace

template <Scalar S>
SegmentStream<S>::SegmentStream(FeedPlan<S>& plan, const MotionLimits<S>& limits) noexcept
    : plan_(&plan), steps_per_mm_q32_(limits.steps_per_mm_q32), segments_per_s_(limits.segments_per_s),
      segment_ticks_(limits.segment_ticks), axes_(limits.axes) {}

template <Scalar S>
void SegmentStream<S>::push_control(const PerAxis<Position>& position) noexcept {
    control_[0] = control_[1];
    control_[1] = control_[2];
    control_[2] = control_[3];
    for (unsigned k = 0; k < static_cast<unsigned>(axes_); ++k) {
        control_[3][k] = scaled(position[k], steps_per_mm_q32_[k], control_shift);
    }
}

// Looks up the time that the front cell takes.
template <Scalar S>
Pull SegmentStream<S>::enter_cell() noexcept {
    const Pull pull = plan_->prepare();
    if (pull != Pull::item) {
        return pull;
    }
    const PlannedCell<S>& planned = plan_->front();
    const S v0 = square_root(planned.entry_sq);
    const S sum = v0 + square_root(planned.exit_sq);
    const S twice = (planned.cell.length_mm + planned.cell.length_mm) * segments_per_s_;
    // The mean speed over constant acceleration is (v0 + v1) / 2; never integrate ds / v.
    hop_ = !(sum > S{});
    duration_ = quotient_or_max(twice, hop_ ? square_root(scale2(planned.reach_from_rest, -2)) : sum);
    entry_ = quotient_or_max(v0 + v0, sum);
    waypoint_ = planned.cell.waypoint;
    in_cell_ = true;
    return Pull::item;
}

// Fraction of the cell's length after the fraction y of its time: constant acceleration. A cell between two stops (a
// crumb between cusps, as a rule) is accelerated for half of its length and braked for the other. From rest the whole
// length would reach v^2 = reach, half of it reach / 2; half of that is used, since a crumb's length has few digits in
// Fixed.
template <Scalar S>
S SegmentStream<S>::position_in_cell() const noexcept {
    const S one = from_integer<S>(1);
    const S y = elapsed_ / duration_;
    if (!hop_) {
        return y * (entry_ + (one - entry_) * y);
    }
    const S to_end = one - y;
    return y < to_end ? scale2(y * y, 1) : one - scale2(to_end * to_end, 1);
}

// Appends the next control point. It can be interrupted by starvation anywhere and goes on where it was.
template <Scalar S>
Pull SegmentStream<S>::sample() noexcept {
    if (hold_ > 0) {
        --hold_;
        control_[0] = control_[1];
        control_[1] = control_[2];
        control_[2] = control_[3];
        return Pull::item;
    }
    if (!in_cell_) {
        const Pull pull = enter_cell();
        if (pull != Pull::item) {
            return pull;
        }
    }
    PerAxis<Position> position{};
    if (!started_) {
        plan_->front().cell.position_at(S{}, position);
        for (int i = 0; i < 3; ++i) {
            push_control(position);
        }
        started_ = true;
    }
    if (!advanced_) {
        elapsed_ += from_integer<S>(1);
        advanced_ = true;
    }
    for (;;) {
        const PlannedCell<S>& planned = plan_->front();
        if (planned.cell.stop_at_end && elapsed_ + literal<S>(arrival) >= duration_) {
            push_control(planned.cell.end);
            hold_ = 2;
            elapsed_ = S{};
            advanced_ = in_cell_ = false;
            plan_->pop();
            return Pull::item;
        }
        if (elapsed_ < duration_) {
            break;
        }
        elapsed_ -= duration_;
        plan_->pop();
        in_cell_ = false;
        const Pull pull = enter_cell();
        if (pull != Pull::item) {
            return pull;
        }
    }
    plan_->front().cell.position_at(position_in_cell(), position);
    push_control(position);
    advanced_ = false;
    return Pull::item;
}

template <Scalar S>
Pull SegmentStream<S>::next(FeedSegment& out) noexcept {
    const Pull pull = sample();
    if (pull != Pull::item) {
        return pull;
    }
    out.index = index_++;
    out.duration_ticks = segment_ticks_;
    out.waypoint = waypoint_;
    for (unsigned k = 0; k < static_cast<unsigned>(axes_); ++k) {
        const std::int64_t c0 = control_[0][k];
        const std::int64_t c1 = control_[1][k];
        const std::int64_t c2 = control_[2][k];
        const std::int64_t c3 = control_[3][k];
        out.start[k] = c0 + 4 * c1 + c2;
        out.end[k] = c1 + 4 * c2 + c3;
        out.start_velocity[k] = 3 * (c2 - c0);
        out.end_velocity[k] = 3 * (c3 - c1);
    }
    return Pull::item;
}

template class SegmentStream<double>;
template class SegmentStream<float>;
template class SegmentStream<Fixed>;

} // namespace splinefeed
