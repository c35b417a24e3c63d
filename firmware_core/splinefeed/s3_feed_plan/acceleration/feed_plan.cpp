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
// and chooses a new profile segment from where the machine is (steered_segment.cpp).
//
// A pass in parts. It counts with the steering that it began with; a request that comes meanwhile stays pending, and a
// pass of its own follows. Behind the place where it is, the cells have new K, before it old ones. That is safe to
// travel, because a K of the machine only grows. But only UnderrunPolicy::urgent does so: otherwise the machine waits
// for the pass. A cell that no pass has visited yet has K = 0, so the old plan ends at standstill before it.
#include "splinefeed/s3_feed_plan/acceleration/feed_plan.hpp"

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

template <Scalar S>
FeedPlan<S>::FeedPlan(ArcLength<S>& source, const MotionLimits<S>& limits, std::span<PlannedCell<S>> window) noexcept
    : source_(&source), limits_(limits), window_(window), turning_(limits) {}

template <Scalar S>
void FeedPlan<S>::begin_pass(bool open_end) noexcept {
    steered_ = steered_ || steering_.pending();
    steering_.acknowledge();
    pass_.begin(window_, steering_.wish(), open_end);
}

template <Scalar S>
bool FeedPlan<S>::run_pass(WorkBudget& work) noexcept {
    if (!pass_.run(window_, limits_, work)) {
        return false;
    }
    planned_ = true;
    return true;
}

// After the pass over a window that holds no committed cell.
template <Scalar S>
void FeedPlan<S>::commit() noexcept {
    if (filled_ == Pull::starved) {
        committed_ = 1;
    } else if (filled_ == Pull::finished) {
        committed_ = window_.size();
    } else {
        const std::size_t quarter = (window_.size() + 3) / 4;
        if (pass_.last_final() < quarter) {
            ++window_limited_;
        }
        committed_ = larger(pass_.last_final(), quarter);
    }
    if (open_ || pass_.open_end()) { // with an open end it may have become faster than the following cells allow
        speed_sq_ = smaller(speed_sq_, front().entry_sq);
    }
    open_ = pass_.open_end();
    wanted_exit_ = smaller(front().exit_sq, reachable_exit());
}

// The machine's K after the front cell.
template <Scalar S>
S FeedPlan<S>::reachable_exit() const noexcept {
    const PlannedCell<S>& here = front();
    const bool last = window_.size() == 1;
    if (here.cell.stop_at_end || (last && !open_)) {
        return S{};
    }
    return last ? here.cap.exit_sq : smaller(window_.at(1).entry_sq, here.cap.exit_sq);
}

template <Scalar S>
void FeedPlan<S>::forward_step(S known_sq) noexcept {
    PlannedCell<S>& here = window_.at(0);
    const S one = from_integer<S>(1);
    chosen_ = true;
    const S fastest_entry = here.entry_sq;
    if (at_ == S{}) {
        here.entry_sq = speed_sq_;
    }
    if (rest_to_rest_) {
        rest_to_rest_ = false;
        profile_segment_ = {{at_}, speed_sq_, {}, here.cell.stop_at_end};
    } else if (may_peak(fastest_entry)) {
        choose_peaked(known_sq);
    } else if (steered_ || at_ > S{}) {
        choose_steered(known_sq);
    } else {
        profile_segment_ = {{}, speed_sq_, exit_from_start(known_sq), false};
    }
    CellInterval<S>& stretch = profile_segment_.stretch;
    const bool to_end = stretch.to == one;
    here.exit_sq = to_end ? profile_segment_.exit_sq : wanted_exit_;
    if (to_end && !(profile_segment_.entry_sq + profile_segment_.exit_sq > S{}) && !profile_segment_.stops) {
        // From standstill to standstill (usually a degenerate cell between cusps): it accelerates over half of the
        // length and brakes over the other half. From standstill the whole length would reach v^2 = reach, half of it
        // reach / 2. Half of that is used, because the length of a degenerate cell has few digits in Fixed.
        const S reach = AccelerationBound<S>(here.cell, limits_).reach_from_standstill(wanted().least_sq());
        profile_segment_.exit_sq = scale2(at_ > S{} ? reach * stretch.length() : reach, -2);
        stretch.to = stretch.from + scale2(stretch.length(), -1);
        rest_to_rest_ = stretch.to < one; // a length of one last digit cannot be halved
        profile_segment_.stops = !rest_to_rest_;
    } else if (to_end && !(profile_segment_.exit_sq > S{})) {
        profile_segment_.stops =
            profile_segment_.stops || here.cell.stop_at_end || window_.size() == 1 || !(window_.at(1).entry_sq > S{});
    }
    // The machine comes on; or it is so slow that it stops within a last digit of where it is.
    SPLINEFEED_ASSERT(stretch.from < stretch.to || rest_to_rest_ || profile_segment_.stops);
}

// The exit nearest to the wanted one from the start of the front cell.
template <Scalar S>
S FeedPlan<S>::exit_from_start(S known_sq) const noexcept {
    return known_sq < wanted_exit_
               ? larger(AccelerationBound<S>(cell(), limits_).largest_exit(speed_sq_, wanted_exit_), known_sq)
               : wanted_exit_;
}

// On a line always. Elsewhere only where that gains: the machine is slow at an end, and not because it brakes.
template <Scalar S>
bool FeedPlan<S>::may_peak(S fastest_entry) const noexcept {
    if (leads_ || steering_.stops() || !has_parts(cell()) || speed_sq_ > wanted().least_sq()) {
        return false;
    }
    const bool brakes = !(speed_sq_ < fastest_entry) && fastest_entry < front().peak.entry_sq;
    return peaks_ || cell().degree == 1 ||
           (!steered_ && at_ == S{} && !brakes && scale2(smaller(speed_sq_, wanted_exit_), 1) < wanted().least_sq());
}

// The speed within the cell need not be between those at its ends.
template <Scalar S>
void FeedPlan<S>::choose_peaked(S known_sq) noexcept {
    S exit = wanted_exit_;
    if (steered_) {
        const AccelerationBound<S> bound(cell(), limits_, {at_});
        exit = bound.smallest_exit(speed_sq_, wanted_exit_, larger(wanted_exit_, reachable_exit()));
        exit = exit > wanted_exit_ ? exit : bound.largest_exit(speed_sq_, wanted_exit_);
        steered_ = !(exit == wanted_exit_);
    } else if (at_ == S{}) {
        wanted_exit_ = exit_from_start(known_sq);
        if (wanted_exit_ < exit) { // it speeds up all the way
            profile_segment_ = {{}, speed_sq_, wanted_exit_, false};
            return;
        }
    }
    profile_segment_ = peaked_segment(
        cell(), limits_,
        PeakTarget<S>{.from = at_, .entry_sq = speed_sq_, .most_sq = wanted().least_sq(), .exit_sq = exit});
    peaks_ = profile_segment_.stretch.to < from_integer<S>(1);
}

template <Scalar S>
void FeedPlan<S>::choose_steered(S known_sq) noexcept {
    const PlannedCell<S>& here = front();
    const S reachable = reachable_exit();
    profile_segment_ =
        steered_segment(here.cell, limits_,
                        SteeringTarget<S>{.from = at_,
                                          .entry_sq = speed_sq_,
                                          .max_steady_sq = wanted().most_sq(),
                                          .level_sq = here.cap.least_sq(),
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
    const PlannedCell<S>& here = front();
    const S share = speed_sq_ < here.entry_sq ? speed_sq_ / here.entry_sq : from_integer<S>(1);
    const S exit = here.entry_sq < here.peak.entry_sq ? here.peak.smallest_exit_sq : here.peak.largest_exit_sq;
    return share * smaller(exit, reachable_exit());
}

// The next cell behind those that are measured.
template <Scalar S>
Pull FeedPlan<S>::measure(WorkBudget& work) noexcept {
    PlannedCell<S>& slot = window_.at(window_.measured());
    const Pull pull = source_->next(slot.cell, work);
    if (pull == Pull::item) {
        slot.cap = SpeedCaps<S>(limits_).cap(slot.cell);
        slot.cell.heading = {};
        slot.entry_sq = slot.exit_sq = S{};
        slot.peak = PeakSpeeds<S>::unknown();
        window_.add_measured();
    }
    return pull;
}

template <Scalar S>
bool FeedPlan<S>::measure_ahead(WorkBudget& work) noexcept {
    Pull pull = Pull::item;
    while (pull == Pull::item && window_.measured() < window_.room()) {
        pull = measure(work);
    }
    return pull == Pull::busy;
}

template <Scalar S>
Pull FeedPlan<S>::fill(WorkBudget& work) noexcept {
    const auto cell_at = [this](std::size_t i) -> Cell<S>& {
        return window_.at(i).cell;
    };
    const auto settled = [this](std::size_t i) {
        window_.at(i).peak = PeakSpeeds<S>::unknown();
        planned_ = false;
    };
    while (window_.size() < window_.room()) {
        if (window_.size() == window_.measured()) {
            const Pull pull = measure(work);
            if (pull == Pull::finished) {
                turning_.end(window_.size(), cell_at, settled);
            }
            if (pull != Pull::item) {
                return pull;
            }
        } else if (!work.take()) {
            return Pull::busy;
        }
        const Cell<S>& added = cell_at(window_.size());
        if (added.stop_before && window_.size() > 0) {
            Cell<S>& before = cell_at(window_.size() - 1);
            before.stop_at_end = true;
            before.end = added.origin;
        }
        window_.take();
        planned_ = false;
        turning_.take(window_.size(), cell_at, settled);
    }
    return Pull::item;
}

// Nothing is committed: takes what there is of the path, and commits a part of it.
template <Scalar S>
Pull FeedPlan<S>::plan(UnderrunPolicy underrun, WorkBudget& work) noexcept {
    if (!pass_.running() || window_.size() == 0) {
        const Pull pull = fill(work);
        if (window_.size() == 0 || pull == Pull::busy) {
            return pull;
        }
        if (pull == Pull::starved && underrun == UnderrunPolicy::wait && !steering_.stops()) {
            return pull;
        }
        filled_ = pull;
        if (pull != Pull::starved || !planned_ || open_ != leads_ || steering_.pending()) {
            begin_pass(pull == Pull::starved && leads_);
        }
    }
    if (pass_.running() && !run_pass(work)) {
        return Pull::busy;
    }
    commit();
    return Pull::item;
}

template <Scalar S>
Pull FeedPlan<S>::prepare(UnderrunPolicy underrun, WorkBudget& work) noexcept {
    if (chosen_) {
        return Pull::item;
    }
    if (steering_.stops() && !(speed_sq_ > S{})) {
        if (steering_.aborts()) {
            return Pull::finished;
        }
        const Pull pull = window_.size() == 0 ? fill(work) : Pull::item; // for a motion that is held before it begins
        return window_.size() == 0 ? pull : Pull::held;
    }
    if (committed_ == 0) {
        const Pull pull = plan(underrun, work);
        if (pull != Pull::item && !(pull == Pull::busy && go_on(underrun))) {
            return pull;
        }
    } else if (pass_.running() || steering_.pending()) {
        if (!replan(work) && !go_on(underrun)) {
            return Pull::busy;
        }
    } else if (at_ == S{}) {
        wanted_exit_ = smaller(front().exit_sq, reachable_exit());
    }
    // While a pass runs, the front cell may have its old K and the next one a new one, which do not belong together.
    const S known = at_ == S{} && !pass_.running() && front().peak.known() ? known_exit() : from_integer<S>(-1);
    forward_step(known);
    return Pull::item;
}

// The budget is spent: a machine that cannot wait goes on by what it has of the plan, as the caps of the steering let
// it.
template <Scalar S>
bool FeedPlan<S>::go_on(UnderrunPolicy underrun) noexcept {
    if (underrun != UnderrunPolicy::urgent || leads_ || !(speed_sq_ > S{})) {
        return false;
    }
    committed_ = larger<std::size_t>(committed_, 1);
    const S exit_sq = at_ == S{} ? front().exit_sq : wanted_exit_;
    wanted_exit_ =
        smaller(smaller(exit_sq, reachable_exit()), wanted().exit_sq); // a new K may be smaller by its last digits
    return true;
}

// The steering changed. Committed cells get new speeds, or are no longer committed.
template <Scalar S>
bool FeedPlan<S>::replan(WorkBudget& work) noexcept {
    if (!pass_.running()) {
        begin_pass(false);
    }
    if (!run_pass(work)) {
        return false;
    }
    steered_ = true;
    open_ = false;
    const std::size_t last_final = pass_.last_final();
    committed_ = window_.size() == 0 || last_final > 0 ? last_final : 1;
    wanted_exit_ = window_.size() == 0 ? S{} : smaller(front().exit_sq, reachable_exit());
    return true;
}

template <Scalar S>
Steered FeedPlan<S>::steer(const PlanState<S>& place, UnderrunPolicy /*underrun*/, WorkBudget& work) noexcept {
    if (!replan(work)) {
        return Steered::busy;
    }
    if (!(place.fraction < profile_segment_.stretch.to)) {
        return Steered::unchanged; // nothing of it is left to be travelled in another way
    }
    const bool whole_path = profile_segment_.stretch.to == from_integer<S>(1);
    const S known = whole_path ? profile_segment_.exit_sq : from_integer<S>(-1);
    at_ = place.fraction;
    speed_sq_ = place.speed_sq;
    rest_to_rest_ = peaks_ = chosen_ = false;
    if (speed_sq_ > S{} || !steering_.stops()) {
        forward_step(known);
    }
    return Steered::changed;
}

template <Scalar S>
void FeedPlan<S>::advance() noexcept {
    const S exit_sq = profile_segment_.exit_sq; // a pass for the steering may have given the cell another one
    if (profile_segment_.stretch.to == from_integer<S>(1)) {
        pop();
    } else {
        at_ = profile_segment_.stretch.to;
        chosen_ = false;
    }
    speed_sq_ = profile_segment_.stops ? S{} : exit_sq;
}

template <Scalar S>
void FeedPlan<S>::rest_at(S fraction) noexcept {
    SPLINEFEED_ASSERT(fraction < profile_segment_.stretch.to);
    at_ = fraction;
    speed_sq_ = S{};
    peaks_ = chosen_ = false;
}

template <Scalar S>
void FeedPlan<S>::pop() noexcept {
    SPLINEFEED_ASSERT(committed_ > 0 && chosen_);
    speed_sq_ = front().exit_sq;
    at_ = S{};
    chosen_ = rest_to_rest_ = peaks_ = false;
    window_.pop();
    pass_.pop();
    --committed_;
}

template <Scalar S>
void FeedPlan<S>::forget() noexcept {
    window_.clear();
    committed_ = 0;
    pass_.cancel();
    turning_.clear();
    at_ = speed_sq_ = S{};
    steered_ = planned_ = open_ = chosen_ = rest_to_rest_ = peaks_ = false;
}

SPLINEFEED_INSTANTIATE_CLASS(FeedPlan)

} // namespace splinefeed
