// SPDX-License-Identifier: MIT
//
// b = v^2 is linear in s along a profile segment, which is a cell or a part of one: the acceleration is constant. The
// limits of a cell (FilteredLimits) are monotone, so
//
// - backward: K_i is the largest b at node i from which the end of the known path can be reached at standstill: the
//   largest entry with an exit K_i+1, at most the speed that may be held constant next to the node. Every lower b is
//   possible, too. A longer window only raises K.
// - forward: never above K. The average keeps its jerk if the acceleration changes its sign only after a time T without
//   acceleration (filtered_limits.cpp). Braking may begin only T after the end of acceleration, so the motion
//   accelerates only to a speed that can be held for T below K. It accelerates only T after the end of braking; this
//   needs no preparation, because a motion at constant speed below K may brake at once if it braked last. Steering can
//   lower the wanted K in that time: then the motion continues above it, but never above the machine's K, until it may
//   brake.
//
// There are two K, as in FeedPlan: the machine's (`machine`), and that of the steering (`override`). A motion that is
// not above the second one stays below it. A motion above it brakes as hard as its cells allow, as soon as it may.
//
// From standstill either sign is allowed: the sampler lets the average come to standstill first.
#include "splinefeed/s3_feed_plan/jerk_filtered/smooth_plan.hpp"

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/s3_feed_plan/limits/crawl.hpp"

namespace splinefeed {

namespace {

constexpr double longest_part =
    0.3; // of a cell at low speed (GradedFeed): a window of shorter ones sees less of the path
constexpr double negligible_part = 1.0 / 1024.0; // of a cell: the profile segment before it includes a part this short
constexpr double gain = 1.0 / 2048.0;            // of v^2: a smaller gain is not worth a profile segment
constexpr int bisections = 12;
constexpr int from_rest = 12; // of them, where it starts from standstill
constexpr double spare_time = 1.0 / 16.0;
constexpr double above = 0x1p-20;   // of v^2: tolerance of K for rounding
constexpr double nothing_mm = 1e-6; // a distance from standstill to standstill that may be too short for a motion

// Shortest distance whose time has enough digits [mm].
template <Scalar S>
constexpr double least_way_mm = std::same_as<S, double> ? 0x1p-40 : 0x1p-22;

// Shortest profile segment, as a part of a cell.
template <Scalar S>
constexpr double least_part = std::same_as<S, float>    ? 0x1p-22
                              : std::same_as<S, double> ? 0x1p-40
                                                        : 0x1p-30;

} // namespace

template <Scalar S>
SmoothPlan<S>::SmoothPlan(FeedPlan<S>& source, const MotionLimits<S>& limits, std::span<SmoothCell<S>> cells) noexcept
    : source_(source, limits, literal<S>(longest_part)), limits_(&limits), window_(limits, cells) {}

template <Scalar S>
Pull SmoothPlan<S>::take(UnderrunPolicy underrun) noexcept {
    WorkBudget unlimited;
    return source_.next(underrun, unlimited, [this](const Cell<S>& cell, S cap_sq, S exit_sq) {
        window_.append(cell, cap_sq, SpeedCaps<S>(*limits_).programmed_sq(cell), exit_sq);
    });
}

// Takes as many cells as there is room for. A motion that has to stop does not wait for more.
template <Scalar S>
Pull SmoothPlan<S>::refill(UnderrunPolicy underrun) noexcept {
    Pull pull = Pull::item;
    while (window_.has_room() && pull == Pull::item) {
        pull = take(underrun);
    }
    starved_ = pull == Pull::starved;
    if (starved_ && underrun == UnderrunPolicy::wait && !steering_.stops()) {
        return pull;
    }
    if (pull == Pull::finished) {
        window_.end_here();
    }
    window_.prepare(!window_.has_room());
    if (known() == 0 && starved_ && underrun == UnderrunPolicy::drain) { // there is nothing to continue with
        window_.end_here();
        window_.prepare(false);
    }
    taken_ = starved_ ? window_.capacity() : 0; // then refill() is called again with every profile segment
    backward_pass(false);
    return pull;
}

// The motion brakes, and the input is late. The reason may be the cells at the end that are not prepared, because the
// average may go beyond them. If that end is taken as a standstill, they are known as well. Where K is at a cap before
// the end, the motion brakes for that cap, whatever comes behind it. Where the prepared cells end with a leg, it brakes
// for that stop: the next leg is prepared when the motion has come to it.
template <Scalar S>
bool SmoothPlan<S>::ends_here() noexcept {
    if (!(profile_segment_.exit_sq < profile_segment_.entry_sq) || window_.prepared() == window_.size() ||
        (known() > 0 && window_.ends_leg(window_.prepared() - 1))) {
        return false;
    }
    for (std::size_t i = 1; i < known(); ++i) {
        const S cap = smaller(ahead(i).bound_sq, smaller(wanted_sq(ahead(i)), wanted_sq(ahead(i - 1))));
        if (!(ahead(i).override_controllable_sq < cap)) {
            return false;
        }
    }
    window_.end_here();
    window_.prepare(false);
    backward_pass(true);
    return true;
}

// @param all  false: ends where nothing changes any more
template <Scalar S>
void SmoothPlan<S>::backward_pass(bool all) noexcept {
    for (std::size_t i = known(); i-- > 0;) {
        SmoothCell<S>& here = ahead(i);
        const FilteredLimits<S> bound = bound_of(here);
        const S machine_beyond = machine_exit(i);
        const S override_beyond = override_exit(i);
        const S wanted = wanted_sq(here);
        const auto reached_from = [&](S beyond, S at_most) {
            return bound.largest_entry(beyond, at_most, here.cell.length_mm, here.max_path_acceleration);
        };
        S machine_sq = reached_from(machine_beyond, here.max_steady_sq);
        const bool alike = machine_beyond == override_beyond && wanted == here.max_steady_sq;
        const S override_reach = alike ? machine_sq : reached_from(override_beyond, wanted);
        S override_sq = override_reach;
        const bool first = window_.front() + i == 0 || window_.ends_leg(window_.front() + i - 1);
        if (first) {
            machine_sq = override_sq = S{};
        } else {
            const SmoothCell<S>& before = window_.at(window_.front() + i - 1);
            machine_sq = smaller(machine_sq, smaller(here.bound_sq, before.max_steady_sq));
            override_sq = smaller(override_sq, smaller(here.bound_sq, wanted_sq(before)));
        }
        const bool same = !all && i < looked_ && machine_sq == here.machine_controllable_sq &&
                          override_sq == here.override_controllable_sq;
        here.machine_controllable_sq = machine_sq;
        here.override_controllable_sq = override_sq;
        here.override_reach = override_reach;
        if (same) {
            break;
        }
    }
    looked_ = known();
}

// Whether a speed can be held for the time of the average, from a place in the front cell on.
template <Scalar S>
bool SmoothPlan<S>::coasts(S from, S speed_sq, S speed) const noexcept {
    const S ticks = from_integer<S>(smoothing_.ticks()) + literal<S>(spare_time);
    S left = speed * (ticks / limits_->segments_per_s) + from * length();
    for (std::size_t i = 0; i < known(); ++i) {
        const SmoothCell<S>& here = ahead(i);
        const S exit = override_exit(i);
        if (speed_sq > exit) {
            const S top = here.override_reach;
            return top > speed_sq && !(here.cell.length_mm * ((top - speed_sq) / (top - exit)) < left);
        }
        if (!(here.cell.length_mm < left)) {
            return true;
        }
        left = left - here.cell.length_mm;
    }
    return false;
}

template <Scalar S>
void SmoothPlan<S>::profile_segment_to(S to, S exit_sq) noexcept {
    profile_segment_ = {{at_, to}, speed_sq_, exit_sq, !(exit_sq > S{})};
    exit_speed_ = exit_sq == speed_sq_ ? speed_ : square_root(exit_sq);
    const S way = length() * profile_segment_.stretch.length();
    const S sum = speed_ + exit_speed_;
    ticks_ = quotient_or_max((way + way) * limits_->segments_per_s, sum);
    profile_segment_.linear = quotient_or_max(speed_ + speed_, sum);
}

// Constant speed, to the end of the cell or until the sign may change. false: so slow that the distance has no digits.
// Then it has hardly started from standstill: both accelerations together take less than T, and no change extends over
// them.
template <Scalar S>
bool SmoothPlan<S>::coast() noexcept {
    const S one = from_integer<S>(1);
    const S left = sign_.left(smoothing_.ticks());
    const S way = speed_ * (left / limits_->segments_per_s);
    if (!(way > literal<S>(least_way_mm<S>))) {
        return false;
    }
    const S to = at_ + larger(quotient_or_max(way, length()), literal<S>(least_part<S>));
    // A part in which the motion has to brake is not omitted, however short it is.
    const bool braked = speed_sq_ > machine_exit(0);
    const bool whole = !(to < one) || !(braked || to < one - literal<S>(negligible_part));
    profile_segment_to(whole ? one : to, speed_sq_);
    return true;
}

// Brakes as hard as the cell allows, to a speed or to the end of the cell.
template <Scalar S>
void SmoothPlan<S>::brake(S goal_sq) noexcept {
    const S one = from_integer<S>(1);
    const S a = bound_of(ahead(0)).braking(speed_sq_, ahead(0).max_path_acceleration);
    const S way = length() * (one - at_);
    const S needed = speed_sq_ - goal_sq;
    const S possible = (way + way) * a;
    if (possible > needed) {
        const S to = at_ + (one - at_) * (needed / possible);
        if (to < one - literal<S>(negligible_part)) {
            profile_segment_to(larger(to, at_ + literal<S>(least_part<S>)), goal_sq);
            return;
        }
    }
    profile_segment_to(one, smaller(larger(speed_sq_ - possible, goal_sq), machine_exit(0)));
}

// Below K: continues at this speed, and along K where K falls to it.
template <Scalar S>
void SmoothPlan<S>::follow() noexcept {
    const S one = from_integer<S>(1);
    const S exit = override_exit(0);
    const bool may_brake = sign_.last() != AccelerationSign::accelerating || rested();
    const S tolerated = may_brake ? S{} : speed_sq_ * literal<S>(above);
    if (!(speed_sq_ > exit + tolerated)) {
        profile_segment_to(one, speed_sq_);
        return;
    }
    const S top = ahead(0).override_reach;
    const S meets = top > speed_sq_ ? (top - speed_sq_) / (top - exit) : S{};
    const S least = may_brake ? literal<S>(negligible_part) : literal<S>(0x1p-20);
    if (meets > at_ + least && (!may_brake || meets < one - least)) {
        profile_segment_to(smaller(meets, one), speed_sq_);
    } else if (may_brake) {
        profile_segment_to(one, exit);
    } else { // the K of the steering has fallen since it accelerated; the machine's K has not
        coast();
    }
}

template <Scalar S>
bool SmoothPlan<S>::accelerate() noexcept {
    const S one = from_integer<S>(1);
    const SmoothCell<S>& here = ahead(0);
    const S exit = override_exit(0);
    const S top = here.override_reach > exit ? here.override_reach : smaller(exit, wanted_sq(here));
    const S worth = speed_sq_ * literal<S>(gain);
    if (!(top > speed_sq_ + worth)) {
        return false;
    }
    if (speed_sq_ > S{} && !coasts(at_, speed_sq_, speed_)) {
        return false;
    }
    const FilteredLimits<S> bound = bound_of(here);
    const S way = length() * (one - at_);
    const S most = bound.largest_exit(speed_sq_, top, way, here.max_path_acceleration);
    const S change = larger(most - speed_sq_, S{});
    S steep = quotient_or_max(change, way + way);
    if (!(most < top)) { // sooner than at the end of the cell
        steep = larger(steep, bound.acceleration(most, here.max_path_acceleration));
    }
    // The place where a speed is reached
    const auto reached = [&](S speed_sq) {
        const S share = quotient_or_max(larger(speed_sq - speed_sq_, S{}), (way + way) * steep);
        return share < one ? at_ + (one - at_) * share : one;
    };
    S speed_sq = most;
    S place = reached(most);
    const S fast = square_root(most);
    if (!coasts(place, most, fast)) {
        S low = speed_;
        S high = fast;
        for (int i = speed_sq_ > S{} ? from_rest : 0; i < bisections + from_rest; ++i) {
            const S middle = scale2(low + high, -1);
            const S square = smaller(middle * middle, most);
            (coasts(reached(square), square, middle) ? low : high) = middle;
        }
        speed_sq = smaller(low * low, most);
        place = reached(speed_sq);
    }
    if (!(speed_sq > speed_sq_ + worth) || !(place > at_)) {
        return false;
    }
    profile_segment_to(place, speed_sq);
    return true;
}

// From standstill to the end of the cell, if the distance is almost zero.
template <Scalar S>
void SmoothPlan<S>::crawl() noexcept {
    const S one = from_integer<S>(1);
    const S way = length() * (one - at_);
    SPLINEFEED_ASSERT(way < literal<S>(nothing_mm));
    profile_segment_to(one, S{});
    profile_segment_.linear = one;
    ticks_ = crawling_ticks(way, *limits_);
}

template <Scalar S>
void SmoothPlan<S>::forward_step() noexcept {
    chosen_ = true;
    SmoothCell<S>& here = ahead(0);
    static_cast<void>(bound_of(here));
    const S exit = override_exit(0);
    const S top = here.override_reach;
    const S allowed = top > exit ? top - (top - exit) * at_ : larger(top, exit);
    if (steering_.stops() || speed_sq_ > allowed + allowed * literal<S>(0x1p-14)) {
        const bool waits = sign_.last() == AccelerationSign::accelerating && !rested() && coast();
        if (!waits) {
            brake(steering_.stops() ? S{} : smaller(exit, speed_sq_));
        }
    } else if ((sign_.last() == AccelerationSign::braking && !rested()) || !accelerate()) {
        if (!(speed_sq_ > S{})) {
            crawl();
            return;
        }
        follow();
        const S left = sign_.left(smoothing_.ticks());
        // It may accelerate before the end of the cell
        if (sign_.last() == AccelerationSign::braking && left > S{} && profile_segment_.exit_sq == speed_sq_ &&
            ticks_ > left) {
            const S end = profile_segment_.stretch.to;
            if (coast() && profile_segment_.stretch.to > end) {
                profile_segment_to(end, speed_sq_);
            }
        }
    }
}

template <Scalar S>
Pull SmoothPlan<S>::prepare(UnderrunPolicy underrun, WorkBudget& /*work*/) noexcept {
    if (chosen_) {
        return Pull::item;
    }
    const bool stands = !(speed_sq_ > S{});
    if (steering_.stops() && stands && steering_.aborts()) {
        return Pull::finished;
    }
    if (known() == 0 || 4 * taken_ >= window_.capacity()) {
        const Pull pull = refill(underrun);
        if (known() == 0 || (starved_ && underrun == UnderrunPolicy::wait && !steering_.stops())) {
            return pull;
        }
    }
    if (steering_.stops() && stands) {
        return Pull::held;
    }
    if (steering_.pending()) {
        steering_.acknowledge();
        backward_pass(true);
    }
    if (stands) {
        sign_ = {};
    }
    forward_step();
    if (starved_ && underrun == UnderrunPolicy::drain && !steering_.stops() && ends_here()) {
        forward_step();
    }
    return Pull::item;
}

template <Scalar S>
void SmoothPlan<S>::advance() noexcept {
    sign_.pass(profile_segment_.entry_sq, profile_segment_.exit_sq, ticks_);
    speed_sq_ = profile_segment_.exit_sq;
    speed_ = exit_speed_;
    at_ = profile_segment_.stretch.to;
    chosen_ = false;
    if (at_ == from_integer<S>(1)) {
        at_ = S{};
        window_.pass_front();
        ++taken_;
        looked_ = looked_ > 0 ? looked_ - 1 : 0;
    }
}

template <Scalar S>
bool SmoothPlan<S>::steer(const PlanState<S>& place) noexcept {
    const S speed = square_root(place.speed_sq);
    // The machine almost stands. It first has to come to standstill or to start; otherwise it would be taken to stand
    // where its average does not.
    if (!(speed * (from_integer<S>(smoothing_.ticks()) / limits_->segments_per_s) > literal<S>(least_way_mm<S>))) {
        return false;
    }
    if (place.time_share > S{}) {
        sign_.pass(profile_segment_.entry_sq, profile_segment_.exit_sq, ticks_ * place.time_share);
    }
    at_ = place.fraction;
    speed_sq_ = place.speed_sq;
    speed_ = speed;
    chosen_ = false;
    return true;
}

template class SmoothPlan<double>;
template class SmoothPlan<float>;
template class SmoothPlan<Fixed>;

} // namespace splinefeed
