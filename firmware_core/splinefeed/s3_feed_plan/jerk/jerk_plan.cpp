// SPDX-License-Identifier: MIT
//
// A straight leg is one move in closed form (s_curve_profile.cpp); other legs follow the plan of the window
// (window_plan.cpp).
#include "splinefeed/s3_feed_plan/jerk/jerk_plan.hpp"

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

namespace {

constexpr double least_part = 0.01; // of a cell: in the last part a change of the steering waits for the next one
// Longest part of a cell at low speed (GradedFeed). Shorter parts than 0.15 cost time and gain nothing. In a short
// window parts of 0.15 would leave less of the path in view, most of all near stops, where 0.3 cuts nothing.
template <Scalar S>
constexpr S longest_part(std::size_t window) noexcept {
    return window < 256 ? literal<S>(0.3) : literal<S>(0.15);
}

} // namespace

template <Scalar S, Floating R>
JerkPlan<S, R>::JerkPlan(FeedPlan<S>& source, const MotionLimits<S>& limits, const JerkStorage<S, R>& storage) noexcept
    : source_(source, limits, longest_part<S>(storage.cells.size())), limits_(&limits), window_(limits, storage),
      plan_(window_), change_(window_) {}

template <Scalar S, Floating R>
R JerkPlan<S, R>::wanted_sq(const Cell<S>& cell, S most_sq) const noexcept {
    return to_floating<R>(SpeedCaps<S>(*limits_).wanted_sq(cell, most_sq, steering_.wish()));
}

template <Scalar S, Floating R>
Pull JerkPlan<S, R>::take(UnderrunPolicy underrun, WorkBudget& work) noexcept {
    return source_.next(underrun, work, [this](const Cell<S>& cell, S cap_sq, S exit_sq) {
        window_.append(cell, to_floating<R>(cap_sq), wanted_sq(cell, cap_sq), to_floating<R>(exit_sq));
        plan_.outdate();
    });
}

template <Scalar S, Floating R>
Pull JerkPlan<S, R>::fill(UnderrunPolicy underrun, WorkBudget& work) noexcept {
    window_.forget_travelled();
    Pull pull = Pull::item;
    while (!window_.full() && pull == Pull::item) {
        pull = take(underrun, work);
        work.charge();
        pull = pull == Pull::item && work.spent() ? Pull::busy : pull;
    }
    return pull;
}

// The next profile segment of a straight move, as far as it lies in the front cell.
template <Scalar S, Floating R>
void JerkPlan<S, R>::forward_step_on_line() noexcept {
    const double length = to_double(window_.node(0).length_mm);
    const double per_length = 1.0 / length;
    const JerkNode<R>& node = window_.node(0);
    const bool last = node.travel == Travel::rest_to_rest || cell().stop_at_end; // the move ends in this cell
    const LinePiece piece = last ? line_.next() : line_.next(length - on_line_mm_);
    const X from = profile_segment_.stretch.from;
    on_line_mm_ = smaller(on_line_mm_ + piece.length_mm, length);
    const X one = from_integer<X>(1);
    const X reached = from_double<X>(on_line_mm_ * per_length);
    const bool to_end = last ? line_.done() : !(on_line_mm_ < length && reached < one);
    // The last phase of a move may be shorter than the last digit of a cell: one digit is reserved for it.
    const X before_end = one - scale2(one, last_digit_log2<X>);
    profile_segment_ = {};
    profile_segment_.stretch = {from, to_end ? one : smaller(reached, before_end)};
    profile_segment_.entry_sq = from_double<X>(piece.entry_mm_s * piece.entry_mm_s);
    profile_segment_.exit_sq = from_double<X>(piece.exit_mm_s * piece.exit_mm_s);
    profile_segment_.shape = SpeedShape::cubic;
    profile_segment_.duration_ms = from_double<X>(1e3 * piece.duration_s);
    profile_segment_.linear = from_double<X>(piece.linear);
    profile_segment_.quadratic = from_double<X>(piece.quadratic);
    profile_segment_.stops = to_end && line_.done();
}

template <Scalar S, Floating R>
void JerkPlan<S, R>::forward_step() noexcept {
    const JerkNode<R>& from = window_.node(0);
    const JerkNode<R>& to = window_.node(1);
    if (!line_.done()) {
        forward_step_on_line();
        return;
    }
    profile_segment_ = {};
    on_line_mm_ = 0.0;
    if (from.travel != Travel::curve) {
        const StraightLeg<S, R> leg(window_);
        line_ = LineTravel(leg.from_rest());
        line_limits_ = leg.limits();
        forward_step_on_line();
        return;
    }
    profile_segment_.entry_sq = from_double<X>(from.b);
    profile_segment_.exit_sq = from_double<X>(to.b);
    const bool starts = !(profile_segment_.entry_sq > X{});
    const bool stops = !(profile_segment_.exit_sq > X{});
    profile_segment_.stops = stops;
    if (starts || stops) { // constant jerk, t = 3 L / v
        profile_segment_.shape = SpeedShape::cubic;
        profile_segment_.duration_ms =
            from_double<X>(3e3 * to_double(from.length_mm) / square_root(starts ? to.b : from.b));
        profile_segment_.linear = from_integer<X>(starts ? 0 : 3);
        profile_segment_.quadratic = from_integer<X>(starts ? 0 : -3);
    } else {
        profile_segment_.shape = SpeedShape::parabola;
        profile_segment_.middle_sq = from_double<X>(from.middle_sq);
    }
}

template <Scalar S, Floating R>
void JerkPlan<S, R>::want() noexcept {
    steering_.acknowledge();
    for (std::size_t i = 0; i < window_.size(); ++i) {
        JerkNode<R>& node = window_.node(i);
        node.wanted_sq = wanted_sq(window_.cell(i), from_double<S>(to_double(node.most_sq)));
    }
}

template <Scalar S, Floating R>
bool JerkPlan<S, R>::change_line(double from, const SpeedState& state) noexcept {
    StraightLeg<S, R> leg(window_, line_limits_);
    if (!(steering_.stops() ? leg.to_rest(from, state) : leg.to_end(from, state))) {
        return false;
    }
    line_ = LineTravel(leg.move());
    plan_.take(leg.cells(), leg.cells());
    window_.node(leg.cells()).b = 0.0; // an earlier plan may have been moving at its end inside the leg
    return true;
}

template <Scalar S, Floating R>
Search JerkPlan<S, R>::change_curve(double from, const SpeedState& state, WorkBudget& work) noexcept {
    if (!change_.running()) {
        change_.begin(from, state, plan_.planned());
        if (steering_.stops()) {
            change_.to_rest(work);
        } else {
            change_.to_wanted(work);
        }
    }
    const Search search = change_.search(work);
    if (search == Search::found) {
        plan_.take(change_.planned(), steering_.stops() ? change_.planned() : change_.changed());
    }
    return search;
}

// A change of the steering while the machine moves. If no other motion is found, the plan stays until there is one from
// where a later profile segment starts; the plan of a stop is travelled to its end, a standstill.
template <Scalar S, Floating R>
Search JerkPlan<S, R>::answer(double from, const SpeedState& state, UnderrunPolicy underrun,
                              WorkBudget& work) noexcept {
    if (steering_.pending() || !change_.running()) {
        change_.cancel();
        plan_.cancel();
        if (state.b < JerkWindow<S, R>::slowest_sq) {
            return Search::none; // later: it has just started, or is about to stop
        }
        want();
        window_.forget_travelled();
        if (halt_ > 0) {
            window_.cell(halt_ - 1).stop_at_end = false;
        }
    }
    const bool on_line = !line_.done();
    const double travelled_mm = from * to_double(window_.node(0).length_mm);
    Search search = !on_line                   ? change_curve(from, state, work)
                    : change_line(from, state) ? Search::found
                                               : Search::none;
    if (search == Search::running && underrun == UnderrunPolicy::urgent) { // the machine leaves this place
        search = Search::none;
        change_.cancel();
    }
    if (search == Search::running) {
        return search;
    }
    answer_ = search == Search::none ? Answer::owed : Answer::given;
    if (search == Search::none) {
        if (halt_ > 0) {
            window_.cell(halt_ - 1).stop_at_end = true;
        }
        plan_.commit(steering_.stops() ? plan_.planned() : plan_.committed());
        return search;
    }
    // Except on a straight move, the rest of the front cell becomes a cell of its own.
    on_line_mm_ = on_line ? travelled_mm : 0.0;
    profile_segment_.stretch.from = from_double<X>(on_line_mm_ / to_double(window_.node(0).length_mm));
    halt_ = 0;
    if (steering_.stops()) {
        plan_.commit(plan_.planned());
        if (!window_.cell(plan_.planned() - 1).stop_at_end) {
            halt_ = plan_.planned();
            Cell<S>& last = window_.cell(halt_ - 1);
            last.stop_at_end = true;
            last.position_at(from_integer<S>(1), last.end);
        }
    }
    return search;
}

template <Scalar S, Floating R>
Steered JerkPlan<S, R>::steer(const PlanState<X>& place, UnderrunPolicy underrun, WorkBudget& work) noexcept {
    const double from = to_double(place.fraction);
    const double left = 1.0 - from;
    const double length_mm = to_double(window_.node(0).length_mm);
    if (line_.done() && (left < least_part || left * length_mm < JerkWindow<S, R>::shortest_mm)) {
        return Steered::unchanged; // it is tried again with the next profile segment
    }
    const SpeedState state = state_on(profile_segment_, length_mm, from, to_double(place.time_share));
    switch (answer(from, state, underrun, work)) {
    case Search::running: return Steered::busy;
    case Search::none: return Steered::unchanged;
    case Search::found: break;
    }
    chosen_ = false;
    return Steered::changed;
}

// Called before a profile segment is chosen. false: the budget is spent.
template <Scalar S, Floating R>
bool JerkPlan<S, R>::follow_steering(UnderrunPolicy underrun, WorkBudget& work) noexcept {
    if (standing()) {
        answer_ = Answer::given;
        change_.cancel();
        want();
        for (std::size_t i = 0; i < window_.size(); ++i) {
            JerkNode<R>& node = window_.node(i);
            node.cap_sq = node.wanted_sq;
        }
        plan_.take(0, 0);
        return true;
    }
    if (line_.done()) {
        return answer(0.0, window_.state(0), underrun, work) != Search::running; // the node moves
    }
    const MoveState& state = line_.reached();
    return answer(to_double(profile_segment_.stretch.from),
                  {state.speed_mm_s * state.speed_mm_s, 2.0 * state.acceleration_mm_s2}, underrun,
                  work) != Search::running;
}

// The budget is spent: a machine that cannot wait goes on by the plan that it has.
template <Scalar S, Floating R>
bool JerkPlan<S, R>::go_on(UnderrunPolicy underrun) noexcept {
    if (underrun != UnderrunPolicy::urgent || plan_.planned() == 0 || !(window_.node(0).b > 0.0)) {
        return false;
    }
    plan_.give_up();
    return true;
}

template <Scalar S, Floating R>
Pull JerkPlan<S, R>::prepare(UnderrunPolicy underrun, WorkBudget& work) noexcept {
    if (chosen_) {
        return Pull::item;
    }
    if (steering_.stops() && standing()) {
        if (steering_.aborts()) {
            return Pull::finished;
        }
        const Pull pull = window_.size() == 0 ? fill(underrun, work) : Pull::item;
        return window_.size() == 0 ? pull : Pull::held;
    }
    if ((steering_.pending() || change_.running() || (answer_ == Answer::due && !plan_.running())) &&
        !follow_steering(underrun, work)) {
        return Pull::busy;
    }
    if (plan_.committed() == 0 && steering_.stops()) {
        plan_.commit(plan_.planned());
    }
    if (plan_.committed() == 0 && !plan_.running()) {
        const Pull pull = work.spent() ? Pull::busy : fill(underrun, work);
        if (pull == Pull::busy && go_on(underrun)) {
            forward_step();
            chosen_ = true;
            return Pull::item;
        }
        if (window_.size() == 0 || pull == Pull::busy || (pull == Pull::starved && underrun == UnderrunPolicy::wait)) {
            return pull;
        }
        if (plan_.complete() && plan_.planned() > 0) {
            // Later cells change the rest of the plan, except for a move that is planned as a whole.
            const bool in_part =
                pull == Pull::starved && !steering_.stops() && line_.done() && window_.node(0).travel == Travel::curve;
            plan_.commit(in_part ? 1 : plan_.planned());
        } else {
            plan_.begin(pull == Pull::finished);
        }
    }
    if (plan_.running() && plan_.committed() == 0 && !plan_.run(work) && !go_on(underrun)) {
        return Pull::busy;
    }
    forward_step();
    chosen_ = true;
    return Pull::item;
}

// From the end of what is committed on, once half of it is travelled: so the machine need not wait for the pass.
template <Scalar S, Floating R>
bool JerkPlan<S, R>::plan_ahead(WorkBudget& work) noexcept {
    if (plan_.committed() == 0 || steering_.pending() || steering_.stops() || change_.running() || halt_ > 0) {
        return false;
    }
    if (!plan_.running()) {
        if (4 * plan_.committed() > window_.size()) {
            return false;
        }
        const Pull pull = fill(UnderrunPolicy::wait, work);
        if (pull != Pull::item && pull != Pull::finished) {
            return pull == Pull::busy;
        }
        if (plan_.complete() || plan_.committed() == window_.size()) {
            return false;
        }
        plan_.begin(pull == Pull::finished);
    }
    static_cast<void>(plan_.run(work));
    return plan_.running();
}

template <Scalar S, Floating R>
void JerkPlan<S, R>::advance() noexcept {
    SPLINEFEED_ASSERT(chosen_);
    chosen_ = false;
    answer_ = answer_ == Answer::owed ? Answer::due : answer_;
    if (!(profile_segment_.stretch.to == from_integer<X>(1))) {
        profile_segment_.stretch.from = profile_segment_.stretch.to;
        return;
    }
    profile_segment_.stretch.from = X{};
    on_line_mm_ = 0.0;
    window_.pop();
    plan_.pop();
    halt_ -= halt_ > 0 ? 1U : 0U;
}

template <Scalar S, Floating R>
void JerkPlan<S, R>::rest_at(X /*fraction*/) noexcept {
    SPLINEFEED_ASSERT(false); // it ends where it says
}

template <Scalar S, Floating R>
bool JerkPlan<S, R>::standing() const noexcept {
    return !chosen_ && line_.done() && !(window_.node(0).b > 0.0);
}

template <Scalar S, Floating R>
void JerkPlan<S, R>::clear() noexcept {
    SPLINEFEED_ASSERT(standing());
    source_.forget();
    window_.clear();
    plan_.clear();
    halt_ = 0;
    on_line_mm_ = 0.0;
    profile_segment_ = {};
    answer_ = Answer::given;
    change_.cancel();
    steering_.start();
}

#define SPLINEFEED_INSTANTIATE(S, R) template class JerkPlan<S, R>;
SPLINEFEED_EACH_JERK_PLAN(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
