// SPDX-License-Identifier: MIT
//
// b = v^2 = (ds/dt)^2 is linear in s within a cell. The pairs of b at its ends with which every axis keeps its
// acceleration are a convex polygon P that contains (0, 0) (acceleration_bound.cpp). The plan is time-optimal by
// reachability (TOPP-RA):
//
// - backward: K_i is the largest b at node i from which standstill at the end of the window can be reached: the largest
//   entry of P with an exit up to K_i+1, limited by the caps next to the node. Because (0, 0) is in P, all of 0 ... K_i
//   are possible.
// - forward: the largest exit that P allows for the entry and K_i+1. There is one, because the entry is at most K_i.
//
// K_i grows with K_i+1 until it is at a cap or the entry is at the peak of P. A longer window can only raise K. So a
// node where one of the two holds is final, and with it every K before it: up to there the plan equals that of an
// unlimited window. The window is committed up to the last such node. If an earlier part is committed without being
// final, K of its last node can only rise afterwards: a stop stays possible.
//
// Steering. There are two K: the machine's K, with its own caps, and the K of the steering, whose caps include the
// programmed feed times the override. The machine's speed is at most the first K at every node, whatever was requested
// before; so every change of the steering can be followed within the limits. Forward, one cell at a time as the machine
// enters it, the exit is the K of the steering, limited to the exits that P allows for the entry and to the machine's K
// at the exit. If the machine is not faster than the steering wants, the lower limit of P has no effect, and the plan
// is that without steering. A change computes the K of the steering again, drops what was committed beyond final nodes,
// and chooses a new profile segment from where the machine is (profile_segment.cpp).
#include "splinefeed/s3_feed_plan/acceleration/feed_plan.hpp"

#include "splinefeed/s3_feed_plan/limits/axis_velocity.hpp"
#include "splinefeed/s3_feed_plan/limits/feed_share.hpp"

namespace splinefeed {

namespace {

// The lowest cap of the speed away from stops, 1e-3 mm/s squared: below that, the time per cell has no digits in Fixed.
// At this speed the acceleration of an axis is less than its smallest limit for any curvature below 1e5 /mm.
constexpr double slowest_sq = 1e-6;

} // namespace

template <Scalar S>
FeedPlan<S>::FeedPlan(ArcLength<S>& source, const MotionLimits<S>& limits, std::span<PlannedCell<S>> window) noexcept
    : source_(&source), limits_(limits), window_(window), turning_(limits) {}

// Cap of a cell. This is the only place where a limit of the speed is stated.
template <Scalar S>
void FeedPlan<S>::bound(PlannedCell<S>& planned) const noexcept {
    const Cell<S>& cell = planned.cell;
    // The block's own maximum limits the feed, whatever is programmed and overridden.
    const S most = cell.max_feed_mm_s > S{} ? smaller(limits_.usable_feed(cell.max_feed_mm_s), limits_.feed_mm_s)
                                            : limits_.feed_mm_s;
    S speed = path_speed(cell, most);
    for (unsigned k = 0; k < static_cast<unsigned>(limits_.axes); ++k) {
        const S velocity = axis_velocity(cell, limits_, k);
        if (cell.tangent_max[k] * speed > velocity) {
            speed = velocity / cell.tangent_max[k];
        }
    }
    speed = smaller(speed, cell.steady_mm_s);
    S cap = speed * speed;
    const S twice = cell.length_mm + cell.length_mm;
    for (unsigned k = 0; k < static_cast<unsigned>(limits_.axes); ++k) {
        if (twice * cell.curvature_max[k] > literal<S>(Cell<S>::sharp_turn)) {
            const S limit = smaller(limits_.acceleration_mm_s2[k], limits_.braking_mm_s2[k]);
            cap = smaller(cap, scale2(limit, -1) / cell.curvature_max[k]);
        }
    }
    if (limits_.centripetal_mm_s2 > S{} || limits_.chord_mm_s2 > S{}) {
        const S curvature = norm(cell.curvature_max.data(), limits_.axes);
        if (limits_.centripetal_mm_s2 > S{}) {
            cap = smaller(cap, quotient_or_max(limits_.centripetal_mm_s2, curvature));
        }
        if (limits_.chord_mm_s2 > S{}) {
            cap = smaller(cap, quotient_or_max(limits_.chord_mm_s2, curvature));
        }
    }
    planned.cap_sq = larger(cap, literal<S>(slowest_sq));
}

// The feed counts the linear axes; the others follow as fast as their own limits allow.
template <Scalar S>
S FeedPlan<S>::path_speed(const Cell<S>& cell, S feed) const noexcept {
    return limits_.mixed ? smaller(quotient_or_max(feed, feed_share(cell, limits_)), limits_.path_mm_s) : feed;
}

template <Scalar S>
S FeedPlan<S>::wanted_sq(const Cell<S>& cell, S cap_sq, S ratio) const noexcept {
    const S programmed = cell.feed_mm_s;
    const S feed = programmed > S{} ? limits_.usable_feed(programmed * ratio) : limits_.feed_mm_s * ratio;
    if (!(feed < limits_.feed_mm_s)) {
        return cap_sq;
    }
    const S speed = path_speed(cell, feed);
    return larger(smaller(cap_sq, speed * speed), literal<S>(slowest_sq));
}

template <Scalar S>
S FeedPlan<S>::programmed_sq(const Cell<S>& cell) const noexcept {
    const S programmed = cell.feed_mm_s;
    const S speed = path_speed(cell, programmed > S{} ? limits_.usable_feed(programmed) : limits_.feed_mm_s);
    return speed * speed;
}

// Backward over the window: entry_sq becomes the largest entry from which the machine's K after the cell can be
// reached; exit_sq becomes the K of the steering there. Returns the last final node of the steering's K, or 0.
template <Scalar S>
std::size_t FeedPlan<S>::backward_pass(bool open_end) noexcept {
    std::size_t last_final = 0;
    S machine_sq{}; // standstill
    S override_sq{};
    S wanted = size_ > 0 ? wanted_sq(at(size_ - 1)) : S{};
    open_ = open_end;
    if (open_end && size_ > 0 && !at(size_ - 1).cell.stop_at_end) {
        machine_sq = at(size_ - 1).cap_sq;
        override_sq = wanted;
    }
    for (std::size_t i = size_; i-- > 0;) {
        PlannedCell<S>& here = at(i);
        S machine_cap = here.cap_sq;
        S override_cap = wanted;
        S wanted_before{};
        if (i > 0) {
            const PlannedCell<S>& before = at(i - 1);
            wanted_before = wanted_sq(before);
            const bool stop = before.cell.stop_at_end;
            machine_cap = stop ? S{} : smaller(machine_cap, before.cap_sq);
            override_cap = stop ? S{} : smaller(override_cap, wanted_before);
        }
        const auto reached_from = [&](S beyond, S at_most) {
            return beyond >= here.peak.smallest_exit_sq
                       ? at_most
                       : AccelerationBound<S>(here.cell, limits_).largest_entry(beyond, at_most);
        };
        const S machine_reach = reached_from(machine_sq, here.peak.entry_sq);
        const bool alike = override_sq == machine_sq && wanted == here.cap_sq;
        const S override_reach = alike ? machine_reach : reached_from(override_sq, smaller(wanted, here.peak.entry_sq));
        if ((override_sq >= here.peak.smallest_exit_sq || override_reach >= override_cap) && last_final == 0) {
            last_final = i;
        }
        here.entry_sq = machine_reach;
        here.exit_sq = override_sq;
        machine_sq = smaller(machine_reach, machine_cap);
        override_sq = smaller(override_reach, override_cap);
        wanted = wanted_before;
    }
    planned_ = true;
    return last_final;
}

template <Scalar S>
void FeedPlan<S>::commit(bool ended) noexcept {
    const std::size_t last_final = backward_pass();
    committed_ = size_;
    if (!ended) {
        const std::size_t quarter = (size_ + 3) / 4;
        if (last_final < quarter) {
            ++window_limited_;
        }
        committed_ = last_final < quarter ? quarter : last_final;
    }
}

// The steering changed. Committed cells get new speeds, or are no longer committed.
template <Scalar S>
void FeedPlan<S>::replan() noexcept {
    steering_.acknowledge();
    steered_ = true;
    const std::size_t last_final = backward_pass();
    committed_ = size_ == 0 || last_final > 0 ? last_final : 1;
    wanted_exit_ = size_ == 0 ? S{} : smaller(at(0).exit_sq, reachable_exit());
}

// The machine's K after the front cell.
template <Scalar S>
S FeedPlan<S>::reachable_exit() const noexcept {
    const PlannedCell<S>& here = at(0);
    if (here.cell.stop_at_end || (size_ == 1 && !open_)) {
        return S{};
    }
    return size_ == 1 ? here.cap_sq : smaller(at(1).entry_sq, here.cap_sq);
}

template <Scalar S>
void FeedPlan<S>::forward_step(S known_sq) noexcept {
    PlannedCell<S>& here = at(0);
    const S one = from_integer<S>(1);
    chosen_ = true;
    if (at_ == S{}) {
        here.entry_sq = speed_sq_;
    }
    if (rest_to_rest_) {
        rest_to_rest_ = false;
        profile_segment_ = {{at_}, speed_sq_, {}, here.cell.stop_at_end};
    } else if (steered_ || at_ > S{}) {
        choose_steered(known_sq);
    } else {
        const S exit =
            known_sq < wanted_exit_
                ? larger(AccelerationBound<S>(here.cell, limits_).largest_exit(speed_sq_, wanted_exit_), known_sq)
                : wanted_exit_;
        profile_segment_ = {{}, speed_sq_, exit, false};
    }
    CellInterval<S>& stretch = profile_segment_.stretch;
    const bool to_end = stretch.to == one;
    here.exit_sq = to_end ? profile_segment_.exit_sq : wanted_exit_;
    if (to_end && !(profile_segment_.entry_sq + profile_segment_.exit_sq > S{}) && !profile_segment_.stops) {
        // From standstill to standstill (usually a degenerate cell between cusps): it accelerates over half of the
        // length and brakes over the other half. From standstill the whole length would reach v^2 = reach, half of it
        // reach / 2. Half of that is used, because the length of a degenerate cell has few digits in Fixed.
        const S reach = AccelerationBound<S>(here.cell, limits_).reach_from_standstill(wanted_sq(here));
        profile_segment_.exit_sq = scale2(at_ > S{} ? reach * stretch.length() : reach, -2);
        stretch.to = stretch.from + scale2(stretch.length(), -1);
        rest_to_rest_ = stretch.to < one; // a length of one last digit cannot be halved
        profile_segment_.stops = !rest_to_rest_;
    } else if (to_end && !(profile_segment_.exit_sq > S{})) {
        profile_segment_.stops = profile_segment_.stops || here.cell.stop_at_end || size_ == 1;
    }
}

template <Scalar S>
void FeedPlan<S>::choose_steered(S known_sq) noexcept {
    const PlannedCell<S>& here = at(0);
    const S reachable = reachable_exit();
    profile_segment_ =
        steered_segment(here.cell, limits_,
                        SteeringTarget<S>{.from = at_,
                                          .entry_sq = speed_sq_,
                                          .max_steady_sq = wanted_sq(here),
                                          .exit_sq = wanted_exit_,
                                          .most_sq = reachable,
                                          .known_sq = known_sq < S{} ? known_sq : smaller(known_sq, reachable),
                                          .rest = steering_.stops()});
    steered_ = steering_.stops() || !(profile_segment_.exit_sq == wanted_exit_);
}

// P is convex: the exit of the largest entry gives an exit for each smaller one. If an axis has almost no inertia, the
// largest exit depends on the last digits of the entry; this one does not.
template <Scalar S>
S FeedPlan<S>::known_exit() const noexcept {
    const PlannedCell<S>& here = at(0);
    const S share = speed_sq_ < here.entry_sq ? speed_sq_ / here.entry_sq : from_integer<S>(1);
    const S exit = here.entry_sq < here.peak.entry_sq ? here.peak.smallest_exit_sq : here.peak.largest_exit_sq;
    return share * smaller(exit, reachable_exit());
}

template <Scalar S>
Pull FeedPlan<S>::fill() noexcept {
    const auto cell_at = [this](std::size_t i) -> Cell<S>& {
        return at(i).cell;
    };
    const auto settled = [this](std::size_t i) {
        PlannedCell<S>& here = at(i);
        here.peak = AccelerationBound<S>(here.cell, limits_).peak(here.cap_sq);
        planned_ = false;
    };
    while (size_ < window_.size()) {
        PlannedCell<S>& slot = at(size_);
        const Pull pull = source_->next(slot.cell);
        if (pull != Pull::item) {
            if (pull == Pull::finished) {
                turning_.end(size_, cell_at, settled);
            }
            return pull;
        }
        bound(slot);
        slot.cell.heading = {};
        slot.peak = AccelerationBound<S>(slot.cell, limits_).peak(slot.cap_sq);
        if (slot.cell.stop_before && size_ > 0) {
            Cell<S>& before = at(size_ - 1).cell;
            before.stop_at_end = true;
            before.end = slot.cell.origin;
        }
        ++size_;
        planned_ = false;
        turning_.take(size_, cell_at, settled);
    }
    return Pull::item;
}

template <Scalar S>
void FeedPlan<S>::lead() noexcept {
    steering_.override_feed(from_integer<S>(2));
    steering_.poll();
    steering_.acknowledge();
    leads_ = true;
}

template <Scalar S>
Pull FeedPlan<S>::prepare(UnderrunPolicy underrun) noexcept {
    if (chosen_) {
        return Pull::item;
    }
    if (steering_.stops() && !(speed_sq_ > S{})) {
        if (steering_.aborts()) {
            return Pull::finished;
        }
        const Pull pull = size_ == 0 ? fill() : Pull::item; // for a motion that is held before it begins
        return size_ == 0 ? pull : Pull::held;
    }
    if (committed_ == 0) {
        const bool was_open = open_;
        const Pull pull = fill();
        if (size_ == 0) {
            return pull;
        }
        if (pull == Pull::starved && underrun == UnderrunPolicy::wait && !steering_.stops()) {
            return pull;
        }
        if (pull == Pull::starved) {
            if (!planned_ || open_ != leads_ || steering_.pending()) {
                backward_pass(leads_);
            }
            committed_ = 1;
        } else {
            commit(pull == Pull::finished);
        }
        if (was_open || open_) { // with an open end it may have become faster than the following cells allow
            speed_sq_ = smaller(speed_sq_, at(0).entry_sq);
        }
        steered_ = steered_ || steering_.pending();
        steering_.acknowledge();
        wanted_exit_ = smaller(at(0).exit_sq, reachable_exit());
    } else if (steering_.pending()) {
        replan();
    } else if (at_ == S{}) {
        wanted_exit_ = smaller(at(0).exit_sq, reachable_exit());
    }
    const S known = at_ == S{} ? known_exit() : from_integer<S>(-1);
    forward_step(known);
    return Pull::item;
}

template <Scalar S>
bool FeedPlan<S>::steer(const Place<S>& place) noexcept {
    const bool whole_path = profile_segment_.stretch.to == from_integer<S>(1);
    const S known = whole_path ? profile_segment_.exit_sq : from_integer<S>(-1);
    at_ = place.fraction;
    speed_sq_ = place.speed_sq;
    rest_to_rest_ = chosen_ = false;
    replan();
    if (speed_sq_ > S{} || !steering_.stops()) {
        forward_step(known);
    }
    return true;
}

template <Scalar S>
void FeedPlan<S>::advance() noexcept {
    if (profile_segment_.stretch.to == from_integer<S>(1)) {
        pop();
        return;
    }
    at_ = profile_segment_.stretch.to;
    speed_sq_ = profile_segment_.exit_sq;
    chosen_ = false;
}

template <Scalar S>
void FeedPlan<S>::rest_at(S fraction) noexcept {
    at_ = fraction;
    speed_sq_ = S{};
    chosen_ = false;
}

template <Scalar S>
void FeedPlan<S>::pop() noexcept {
    SPLINEFEED_ASSERT(committed_ > 0 && chosen_);
    speed_sq_ = front().exit_sq;
    at_ = S{};
    chosen_ = rest_to_rest_ = false;
    head_ = ring_index(head_ + 1, window_.size());
    --size_;
    --committed_;
}

template <Scalar S>
void FeedPlan<S>::clear() noexcept {
    SPLINEFEED_ASSERT(standing());
    forget();
    steering_.start();
}

template <Scalar S>
void FeedPlan<S>::forget() noexcept {
    size_ = committed_ = 0;
    turning_.clear();
    at_ = speed_sq_ = S{};
    steered_ = planned_ = open_ = chosen_ = rest_to_rest_ = false;
}

template class FeedPlan<double>;
template class FeedPlan<float>;
template class FeedPlan<Fixed>;

} // namespace splinefeed
