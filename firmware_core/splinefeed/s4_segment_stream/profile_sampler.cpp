// SPDX-License-Identifier: MIT
//
// A change of the steering acts on the motion after the last control point, which is T ahead of the start of the next
// segment: from that point on the plan chooses another profile segment. Differences of samples across that point
// average accelerations of both plans, which keep the limits. So a hold would need a whole segment until it brakes
// fully: the second difference at that point is
//
//   (h_old + h_new) T^2 / 2 - q' d T
//
// with h the accelerations averaged over the segment before and after, and d a jump of the speed from the old plan to
// the new. Since |h_new| <= A, it stays within A T^2 if |q'| d <= T (A + h_old) / 2, with h_old positive in the
// direction of motion: the new plan starts with a speed that is lower by this, and stops half a segment earlier. h_old
// T^2 / 2 = q' v T minus the last difference.
//
// A stop that is not tied to a place (of a hold) may be made up to T / 2 early, on the sample itself: on the way to
// standstill at t, |q'| <= A (t - time), so the last difference is below A T (T / 2 + T / 2).
//
// A stop at a place is on its sample, too. Braking with A at most, the machine is within A (T + r)^2 / 2 of it at the
// sample before the last one, if it arrives r after the last one. So the last sample may be the place itself, and the
// machine arrives r early, if (T + r)^2 / 2 <= T^2: r <= (sqrt(2) - 1) T. The same holds for a motion that leaves it:
// its first sample may be at T + r. Along a bent path an axis can reverse in that time, and the sum of both
// accelerations be too large: so the differences that the shift changes are looked at. They are two second differences,
// each with the limit A T^2, and one first difference, which is smaller than that beside it.
#include "splinefeed/s4_segment_stream/profile_sampler.hpp"

#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

namespace {

// Up to this fraction of a segment early counts as arrived: rounding must not decide about an exact multiple of the
// segment duration. The control point moves by A (T/1024)^2 / 2, a 2e-6 part of a second difference.
constexpr double arrival = 1.0 / 1024.0;

// If A T^2 / 2 is below this, in 2^-12 mm, it has too few digits to brake with.
constexpr double least_change = 1.0 / 256.0;
constexpr double kept_for_rounding = 0.98;

constexpr double head_start = 0.414;
constexpr double kept_of_change = 0.9999; // for the rounding of control points
constexpr int fine = 12;                  // lengths in units of 2^-12 mm

} // namespace

template <Scalar S, Scalar X>
ProfileSampler<S, X>::ProfileSampler(SampledPlan<S, X>& plan, const MotionLimits<S>& limits) noexcept
    : plan_(&plan), segments_per_s_(converted<X>(limits.segments_per_s)), axes_(limits.axes) {
    for (const unsigned k : indices(axes_)) {
        braking_mm_s2_[k] = converted<X>(smaller(limits.acceleration_mm_s2[k], limits.braking_mm_s2[k]));
    }
    between_samples_ = !limits.jerk_limited;
}

// Computes the time of the plan's next profile segment.
template <Scalar S, Scalar X>
Pull ProfileSampler<S, X>::enter_segment(UnderrunPolicy underrun, WorkBudget& work) noexcept {
    const Pull pull = plan_->prepare(underrun, work);
    if (pull != Pull::item) {
        return pull;
    }
    motion_ = ProfileMotion<X>(plan_->profile_segment(), converted<X>(plan_->cell().length_mm), segments_per_s_);
    waypoint_ = plan_->cell().waypoint;
    work.charge();
    return Pull::item;
}

// Fraction of the cell's length where the machine is at a time since the start of the profile segment.
template <Scalar S, Scalar X>
X ProfileSampler<S, X>::fraction_at(X time) const noexcept {
    const X x = motion_.at(motion_.share_of(time));
    const CellInterval<X>& stretch = plan_->profile_segment().stretch;
    return stretch.whole() ? x : stretch.from + stretch.length() * x;
}

// The speed from which a stop may start at the last control point.
template <Scalar S, Scalar X>
X ProfileSampler<S, X>::braked(X x, X speed) const noexcept {
    PerAxis<X> direction{};
    plan_->cell().direction_at(x, direction);
    const X way = scale2(speed, fine) / segments_per_s_;
    X less = way;
    for (const unsigned k : indices(axes_)) {
        const X half = scale2(braking_mm_s2_[k] / segments_per_s_, fine - 1) / segments_per_s_;
        const bool forward = direction[k] > X{};
        const X along = absolute(direction[k]);
        const X last = distance<X>(previous_[k], position_[k], -fine);
        const X room = half + along * way - (forward ? last : -last);
        if (half < literal<X>(least_change) || !(room > X{}) || !(way > X{})) {
            return speed;
        }
        less = smaller(less, quotient_or_max(room * literal<X>(kept_for_rounding), along));
    }
    return speed * ((way - less) / way);
}

// The last sample is a stop.
template <Scalar S, Scalar X>
void ProfileSampler<S, X>::rest() noexcept {
    repeats_ = 2;
    previous_ = position_;
    resting_ = true;
}

// Chooses the profile segment from the place of the last control point. false: the budget is spent.
template <Scalar S, Scalar X>
bool ProfileSampler<S, X>::follow_steering(UnderrunPolicy underrun, WorkBudget& work) noexcept {
    const X v0 = square_root(plan_->profile_segment().entry_sq);
    const X v1 = square_root(plan_->profile_segment().exit_sq);
    const X share = motion_.share_of(elapsed_);
    const X x = fraction_at(elapsed_);
    X speed = v0 + (v1 - v0) * share;
    // Without a jump of the acceleration the hold needs no correction at its start.
    if (plan_->steering().stops() && plan_->profile_segment().shape == SpeedShape::line) {
        speed = braked(x, speed);
    }
    const PlanState<X> place{.fraction = x, .speed_sq = speed * speed, .time_share = share};
    const Steered steered = plan_->steer(place, underrun, work);
    if (steered != Steered::changed) {
        return steered != Steered::busy;
    }
    elapsed_ = X{};
    place_ = Place::between;
    if (plan_->standing()) {
        rest(); // so slow that the last control point is the stop
    }
    return true;
}

// Whether a second difference of the samples keeps the acceleration of an axis.
template <Scalar S, Scalar X>
bool ProfileSampler<S, X>::within(unsigned axis, X change) const noexcept {
    const X size = absolute(change);
    const X largest = scale2(braking_mm_s2_[axis] / segments_per_s_, fine) / segments_per_s_;
    return !(size > X{}) || (size <= literal<X>(kept_of_change) * largest && largest > literal<X>(least_change));
}

template <Scalar S, Scalar X>
bool ProfileSampler<S, X>::may_arrive_at(const PerAxis<Position>& stop) const noexcept {
    for (const unsigned k : indices(axes_)) {
        const X before = distance<X>(older_[k], previous_[k], -fine);
        const X last = distance<X>(previous_[k], stop[k], -fine);
        if (!within(k, last - before) || !within(k, last) || absolute(last) > absolute(before)) {
            return false;
        }
    }
    return true;
}

// Whether the first sample of a motion from rest may be later in it: the profile segment lasts that long.
template <Scalar S, Scalar X>
bool ProfileSampler<S, X>::may_leave() const noexcept {
    const X first = literal<X>(1.0 + head_start);
    const X second = literal<X>(2.0 + head_start);
    const ProfileSegment<X>& profile_segment = plan_->profile_segment();
    if (!between_samples_ || !resting_ || elapsed_ > X{} || profile_segment.shape != SpeedShape::line ||
        profile_segment.entry_sq > X{} || !(second < motion_.duration())) {
        return false;
    }
    PerAxis<Position> near{};
    PerAxis<Position> far{};
    plan_->cell().position_at(fraction_at(first), near);
    plan_->cell().position_at(fraction_at(second), far);
    for (const unsigned k : indices(axes_)) {
        const X before = distance<X>(position_[k], near[k], -fine);
        const X behind = distance<X>(near[k], far[k], -fine);
        if (!within(k, before) || !within(k, behind - before) || absolute(before) > absolute(behind)) {
            return false;
        }
    }
    return true;
}

// The control point of a stop, if the machine comes to one before the next sample.
template <Scalar S, Scalar X>
bool ProfileSampler<S, X>::arrive() noexcept {
    const ProfileSegment<X>& profile_segment = plan_->profile_segment();
    if (!profile_segment.stops) {
        return false;
    }
    const Cell<S>& cell = plan_->cell();
    // With a limited jerk the last part of the way to standstill is no longer than rounding.
    const bool bound_to_place = !plan_->steering().stops() || profile_segment.shape != SpeedShape::line;
    const X early = !bound_to_place ? literal<X>(0.5) : between_samples_ ? literal<X>(head_start) : literal<X>(arrival);
    if (elapsed_ + early < motion_.duration()) {
        return false;
    }
    const X end = profile_segment.stretch.to;
    const X x = !bound_to_place && elapsed_ < motion_.duration() ? smaller(fraction_at(elapsed_), end) : end;
    PerAxis<Position> stop = cell.end;
    if (!cell.stop_at_end || !(x == from_integer<X>(1))) {
        cell.position_at(x, stop);
    }
    if (bound_to_place && elapsed_ + literal<X>(arrival) < motion_.duration() && !may_arrive_at(stop)) {
        return false;
    }
    position_ = stop;
    if (x < end) {
        plan_->rest_at(x);
    } else { // also where a place before it is rounded to it: behind the end there is nothing to continue on
        plan_->advance();
    }
    rest();
    elapsed_ = X{};
    place_ = Place::between;
    return true;
}

// An underrun may interrupt it anywhere; it continues where it was.
template <Scalar S, Scalar X>
Pull ProfileSampler<S, X>::next(UnderrunPolicy underrun, WorkBudget& work) noexcept {
    if (place_ == Place::on_segment && (steers_ || plan_->steering().pending())) {
        steers_ = !follow_steering(underrun, work);
        if (steers_ && underrun != UnderrunPolicy::urgent) {
            return Pull::busy;
        }
    }
    if (repeats_ > 0) {
        --repeats_;
        return Pull::item;
    }
    const Pull entered = place_ == Place::on_segment ? Pull::item : enter_segment(underrun, work);
    if (place_ == Place::fresh && (entered == Pull::item || entered == Pull::held)) {
        plan_->cell().position_at(X{}, origin_);
        previous_ = position_ = origin_;
        resting_ = true;
        place_ = Place::between;
    }
    if (entered != Pull::item) {
        return entered;
    }
    if (place_ != Place::past) {
        elapsed_ += may_leave() ? literal<X>(1.0 + head_start) : from_integer<X>(1);
        older_ = previous_;
        previous_ = position_;
        resting_ = false;
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
        place_ = Place::past;
        const bool may_wait = underrun != UnderrunPolicy::urgent;
        const Pull pull = may_wait && work.spent() ? Pull::busy : enter_segment(underrun, work);
        if (pull != Pull::item) {
            return pull;
        }
    }
    plan_->cell().position_at(fraction_at(elapsed_), position_);
    place_ = Place::on_segment;
    return Pull::item;
}

#define SPLINEFEED_INSTANTIATE(S, X) template class ProfileSampler<S, X>;
SPLINEFEED_EACH_SAMPLED(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
