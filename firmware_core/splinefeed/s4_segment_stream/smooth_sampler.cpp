// SPDX-License-Identifier: MIT
//
// The samples are q(s_f(k T)), with T a tick, the duration of a segment. If s_f is jerk-limited, their differences keep
// every limit (segment_stream.cpp). s_f is the mean of the motion s(t) over a number of ticks, and so the mean of the
// means over each tick. In a profile segment of length l and duration d, with u the fraction of time, s = l u (c + (1 -
// c) u), c = profile_segment().linear. The mean of a parabola over a part w of the profile segment's time is the mean
// of its ends minus a twelfth of the second difference, (1 - c) l (w / d)^2 / 6.
//
// When the motion comes to standstill, the mean does so T later, exactly: all its positions are then equal. Two more
// ticks make three equal samples. Then the next motion may begin, and be averaged over another time.
#include "splinefeed/s4_segment_stream/smooth_sampler.hpp"

namespace splinefeed {

// Chooses the profile segment from where the motion is at the end of the last tick. If it cannot be steered there, it
// is asked again at the next tick.
template <Scalar S>
void SmoothSampler<S>::follow_steering() noexcept {
    const ProfileSegment<S>& profile_segment = plan_->profile_segment();
    const S one = from_integer<S>(1);
    const S ticks = plan_->ticks();
    const S share = smaller(elapsed_ / ticks, one);
    const S x =
        profile_segment.stretch.from +
        profile_segment.stretch.length() * (share * (profile_segment.linear + (one - profile_segment.linear) * share));
    const S v0 = square_root(profile_segment.entry_sq);
    const S v1 = square_root(profile_segment.exit_sq);
    const S speed = v0 + (v1 - v0) * share;
    in_segment_ = !plan_->steer(
        {.fraction = smaller(x, one),
         .speed_sq = profile_segment.entry_sq == profile_segment.exit_sq ? profile_segment.entry_sq : speed * speed,
         .time_share = share});
}

// Travels the profile segment as far as the time of this tick allows.
template <Scalar S>
void SmoothSampler<S>::travel() noexcept {
    const ProfileSegment<S>& profile_segment = plan_->profile_segment();
    const S one = from_integer<S>(1);
    const S ticks = plan_->ticks();
    const S length = scale2(plan_->cell().length_mm, fine);
    const bool ends = !(ticks - elapsed_ > left_);
    const S time = ends ? ticks - elapsed_ : left_;
    S x = profile_segment.stretch.to;
    if (!ends) {
        const S share = (elapsed_ + time) / ticks;
        x = profile_segment.stretch.from +
            profile_segment.stretch.length() *
                (share * (profile_segment.linear + (one - profile_segment.linear) * share));
    }
    const PathPosition there = displaced(plan_->cell_start(), x == one ? length : length * x, -fine);
    const S before = distance<S>(tick_start_, place_, -fine);
    const S way = distance<S>(place_, there, -fine);
    const S part = ticks > S{} ? quotient_or_max(time, ticks) : S{};
    const S bow = (one - profile_segment.linear) * (length * profile_segment.stretch.length()) * part * part *
                  literal<S>(1.0 / 6.0);
    sum_ = sum_ + time * (before + scale2(way, -1) - bow);
    left_ = left_ - time;
    elapsed_ = elapsed_ + time;
    place_ = there;
    if (ends) {
        arrive();
    }
}

// At the end of a profile segment.
template <Scalar S>
void SmoothSampler<S>::arrive() noexcept {
    in_segment_ = false;
    plan_->advance();
    if (plan_->standing()) {
        sum_ = sum_ + left_ * distance<S>(tick_start_, place_, -fine);
        left_ = S{};
        rests_ = true;
        rested_ = 0;
        dwell_ = mean_.reach() + 2;
    }
}

// A motion from standstill: on another leg the average may have another length.
template <Scalar S>
void SmoothSampler<S>::begin() noexcept {
    if (!begun_) {
        begun_ = true;
        place_ = plan_->cell_start();
        mean_.reset(place_, plan_->smoothing_q8());
    } else if (mean_.duration_q8() != plan_->smoothing_q8()) {
        mean_.reset(place_, plan_->smoothing_q8());
    }
    rests_ = false;
    elapsed_ = S{};
    in_segment_ = true;
}

// One tick of the motion.
template <Scalar S>
Pull SmoothSampler<S>::tick(UnderrunPolicy underrun, WorkBudget& work) noexcept {
    if (rests_ && rested_ < dwell_) {
        ++rested_;
        mean_.push(place_);
        return Pull::item;
    }
    if (rests_) {
        const Pull pull = plan_->prepare(underrun, work);
        if (!begun_ && (pull == Pull::item || pull == Pull::held) && !plan_->empty()) {
            plan_->cell().position_at(S{}, origin_);
            position_ = origin_;
        }
        if (pull != Pull::item) {
            return pull;
        }
        begin();
    }
    if (!in_tick_) {
        if (in_segment_ && plan_->steering().pending()) {
            follow_steering();
        }
        tick_start_ = place_;
        sum_ = S{};
        left_ = from_integer<S>(1);
        in_tick_ = true;
    }
    while (left_ > S{}) {
        if (!in_segment_) {
            const Pull pull = plan_->prepare(underrun, work);
            if (pull != Pull::item) {
                return pull;
            }
            elapsed_ = S{};
            in_segment_ = true;
        }
        travel();
    }
    in_tick_ = false;
    const PathPosition mean = displaced(tick_start_, sum_, -fine);
    mean_.push(units_between(mean, place_) > 0 ? mean : place_);
    return Pull::item;
}

// Finds where the mean is on the curve.
template <Scalar S>
void SmoothSampler<S>::locate(PathPosition mean) noexcept {
    for (;;) {
        const SmoothCell<S>& here = plan_->oldest();
        const std::int64_t beyond = units_between(displaced(here.start, here.cell.length_mm, 0), mean);
        if (beyond > 0 && plan_->can_release()) {
            plan_->release();
            continue;
        }
        waypoint_ = here.cell.waypoint;
        if (beyond >= 0 && here.cell.stop_at_end) {
            position_ = here.cell.end;
            return;
        }
        const S x = distance<S>(here.start, mean, -fine) / scale2(here.cell.length_mm, fine);
        here.cell.position_at(larger(smaller(x, from_integer<S>(1)), S{}), position_);
        return;
    }
}

template <Scalar S>
Pull SmoothSampler<S>::next(UnderrunPolicy underrun, WorkBudget& work) noexcept {
    const Pull pull = tick(underrun, work);
    if (pull == Pull::item) {
        locate(mean_.value());
    }
    return pull;
}

template class SmoothSampler<double>;
template class SmoothSampler<float>;
template class SmoothSampler<Fixed>;

} // namespace splinefeed
