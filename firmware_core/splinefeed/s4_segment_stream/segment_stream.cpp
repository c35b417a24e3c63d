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
//
// A change of the steering acts on the motion behind the last control point, which is T ahead of the start of the next
// segment: where that point is, the plan chooses another passage. Differences of samples across that point average
// accelerations of both plans, which keep the limits. So a hold would take a whole segment to brake fully: the second
// difference at that point is
//
//   (h_old + h_new) T^2 / 2 - q' d T
//
// with h the accelerations averaged over the segment before and after, and d a jump of the speed from the old plan to
// the new. Since |h_new| <= A, it stays within A T^2 where |q'| d <= T (A + h_old) / 2, h_old counted along the motion:
// the new plan starts with a speed that much lower, and stops half a segment earlier. h_old T^2 / 2 = q' v T less the
// last difference.
//
// A stop that is not bound to a place (of a hold) may be made up to
// T / 2 early, on the sample itself: on the way to rest at t, |q'| <= A (t - time), so that the last difference is
// below A T (T / 2 + T / 2).
#include "splinefeed/s4_segment_stream/segment_stream.hpp"

namespace splinefeed {

namespace {

// Arriving up to this fraction of a segment early counts as arriving: an exact multiple of the segment duration must
// not be decided by rounding. The control point moves by A (T/1024)^2 / 2, a 2e-6 part of a second difference.
constexpr double arrival = 1.0 / 1024.0;

// An A T^2 / 2 below this, in 2^-12 mm, has too few digits to brake with; what is left of it otherwise.
constexpr double least_change = 1.0 / 256.0;
constexpr double kept_for_rounding = 0.98;

// From 2^-40 mm times Q32.32 counts per mm to multiples of 6 units: 6 units are 2^-29 counts.
constexpr int control_shift = Position::fraction_bits + 32 - 29;

} // namespace

template <Scalar S>
SegmentStream<S>::SegmentStream(MotionPlan<S>& plan, const MotionLimits<S>& limits) noexcept
    : plan_(&plan), steps_per_mm_q32_(limits.steps_per_mm_q32), segments_per_s_(limits.segments_per_s),
      segment_ticks_(limits.segment_ticks), axes_(limits.axes) {
    for (unsigned k = 0; k < static_cast<unsigned>(axes_); ++k) {
        braking_mm_s2_[k] = smaller(limits.acceleration_mm_s2[k], limits.braking_mm_s2[k]);
    }
}

template <Scalar S>
void SegmentStream<S>::repeat_control() noexcept {
    control_[0] = control_[1];
    control_[1] = control_[2];
    control_[2] = control_[3];
}

template <Scalar S>
void SegmentStream<S>::push_control() noexcept {
    repeat_control();
    for (unsigned k = 0; k < static_cast<unsigned>(axes_); ++k) {
        control_[3][k] = scaled(position_[k], steps_per_mm_q32_[k], control_shift);
    }
}

// Looks up the time that the plan's next passage takes.
template <Scalar S>
Pull SegmentStream<S>::enter_passage(Starvation starvation) noexcept {
    const Pull pull = plan_->prepare(starvation);
    if (pull != Pull::item) {
        return pull;
    }
    motion_ = PassageMotion<S>(plan_->passage(), plan_->cell().length_mm, segments_per_s_);
    waypoint_ = plan_->cell().waypoint;
    in_passage_ = true;
    return Pull::item;
}

// Fraction of the cell's length where the machine is.
template <Scalar S>
S SegmentStream<S>::fraction() const noexcept {
    const S x = motion_.at(elapsed_ / motion_.duration());
    const Stretch<S>& stretch = plan_->passage().stretch;
    return stretch.whole() ? x : stretch.from + stretch.length() * x;
}

// The speed from which a stop may start at the last control point.
template <Scalar S>
S SegmentStream<S>::braked(S x, S speed) const noexcept {
    constexpr int fine = 12; // lengths in units of 2^-12 mm
    PerAxis<S> direction{};
    plan_->cell().direction_at(x, direction);
    const S way = scale2(speed, fine) / segments_per_s_;
    S less = way;
    for (unsigned k = 0; k < static_cast<unsigned>(axes_); ++k) {
        const S half = scale2(braking_mm_s2_[k] / segments_per_s_, fine - 1) / segments_per_s_;
        const bool forward = direction[k] > S{};
        const S along = absolute(direction[k]);
        const S last = distance<S>(previous_[k], position_[k], -fine);
        const S room = half + along * way - (forward ? last : -last);
        if (half < literal<S>(least_change) || !(room > S{}) || !(way > S{})) {
            return speed;
        }
        less = smaller(less, quotient_or_max(room * literal<S>(kept_for_rounding), along));
    }
    return speed * ((way - less) / way);
}

// The passage from where the last control point is.
template <Scalar S>
void SegmentStream<S>::follow_steering() noexcept {
    const S v0 = square_root(plan_->passage().entry_sq);
    const S v1 = square_root(plan_->passage().exit_sq);
    const S share = elapsed_ / motion_.duration();
    const S x = fraction();
    S speed = v0 + (v1 - v0) * share;
    // Without a jump of the acceleration there is nothing that takes a segment to begin.
    if (plan_->steering().stops() && plan_->passage().shape == SpeedShape::line) {
        speed = braked(x, speed);
    }
    if (!plan_->steer({.fraction = x, .speed_sq = speed * speed, .time_share = share})) {
        return;
    }
    elapsed_ = S{};
    in_passage_ = false;
    if (plan_->standing()) {
        repeats_ = 2; // so slow that the last control point is the stop
    }
}

// The control point of a stop, if the machine comes to one before the next sample.
template <Scalar S>
bool SegmentStream<S>::arrive() noexcept {
    const Passage<S>& passage = plan_->passage();
    if (!passage.stops) {
        return false;
    }
    const Cell<S>& cell = plan_->cell();
    // With a limited jerk the last of the way to rest is no longer than rounding.
    const bool bound_to_place = !plan_->steering().stops() || passage.shape != SpeedShape::line;
    const S early = bound_to_place ? literal<S>(arrival) : literal<S>(0.5);
    if (elapsed_ + early < motion_.duration()) {
        return false;
    }
    if (!bound_to_place && elapsed_ < motion_.duration()) {
        const S x = fraction();
        cell.position_at(x, position_);
        plan_->rest_at(x);
    } else {
        if (cell.stop_at_end && passage.stretch.to == from_integer<S>(1)) {
            position_ = cell.end;
        } else {
            cell.position_at(passage.stretch.to, position_);
        }
        plan_->advance();
    }
    push_control();
    repeats_ = 2;
    elapsed_ = S{};
    advanced_ = in_passage_ = false;
    return true;
}

// Appends the next control point. It can be interrupted by starvation anywhere and goes on where it was.
template <Scalar S>
Pull SegmentStream<S>::sample(Starvation starvation) noexcept {
    if (in_passage_ && !advanced_ && plan_->steering().news()) {
        follow_steering();
    }
    if (repeats_ > 0) {
        --repeats_;
        repeat_control();
        return Pull::item;
    }
    const Pull entered = in_passage_ ? Pull::item : enter_passage(starvation);
    if (!started_ && (entered == Pull::item || entered == Pull::held)) {
        plan_->cell().position_at(S{}, position_);
        for (int i = 0; i < 3; ++i) {
            push_control();
        }
        started_ = true;
    }
    if (entered != Pull::item) {
        return entered;
    }
    if (!advanced_) {
        previous_ = position_;
        elapsed_ += from_integer<S>(1);
        advanced_ = true;
    }
    for (;;) {
        if (arrive()) {
            return Pull::item;
        }
        if (elapsed_ < motion_.duration()) {
            break;
        }
        elapsed_ -= motion_.duration();
        plan_->advance();
        in_passage_ = false;
        const Pull pull = enter_passage(starvation);
        if (pull != Pull::item) {
            return pull;
        }
    }
    plan_->cell().position_at(fraction(), position_);
    push_control();
    advanced_ = false;
    return Pull::item;
}

template <Scalar S>
Pull SegmentStream<S>::next(FeedSegment& out, Starvation starvation) noexcept {
    const Pull pull = sample(starvation);
    if (pull == Pull::item) {
        write(out);
    }
    return pull;
}

template <Scalar S>
void SegmentStream<S>::stand(FeedSegment& out) noexcept {
    SPLINEFEED_ASSERT(at_rest());
    repeat_control();
    write(out);
}

template <Scalar S>
void SegmentStream<S>::write(FeedSegment& out) noexcept {
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
}

template class SegmentStream<double>;
template class SegmentStream<float>;
template class SegmentStream<Fixed>;

} // namespace splinefeed
