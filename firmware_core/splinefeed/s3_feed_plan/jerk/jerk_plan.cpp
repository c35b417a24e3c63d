// SPDX-License-Identifier: MIT
//
// The window is planned leg by leg, from a stop (or from where the machine will be) to the next stop (or to standstill
// at the end of the known path). A leg that ends at a stop is final; of a leg that ends with the window, the first half
// is committed. The rest is planned again when more of the path is known. Its old plan is kept. If no new one is found
// from the state at the end of the committed part, the old one is travelled to its end, which is a standstill.
//
// A straight leg is one move in closed form (s_curve_profile.cpp).
#include "splinefeed/s3_feed_plan/jerk/jerk_plan.hpp"

#include "splinefeed/base/assertion.hpp"

namespace splinefeed {

namespace {

constexpr double least_part = 0.01; // of a cell: in the last part a change of the steering waits for the next one
// Longest part of a cell at low speed (GradedFeed). Shorter parts than 0.15 cost time and gain nothing. In a short
// window parts of 0.15 would leave less of the path in view, most of all near stops, where 0.3 cuts nothing.
template <Scalar S>
constexpr S longest_part(std::size_t window) noexcept {
    return window < 256 ? literal<S>(0.3) : literal<S>(0.15);
}
template <Scalar S>
constexpr int last_digit_log2 = std::same_as<S, Fixed> ? -32 : -52; // of fractions of a cell

} // namespace

template <Scalar S>
JerkPlan<S>::JerkPlan(FeedPlan<S>& source, const MotionLimits<S>& limits, const JerkStorage<S>& storage) noexcept
    : source_(source, limits, longest_part<S>(storage.cells.size())), limits_(&limits), window_(limits, storage),
      leg_(storage.scratch) {}

template <Scalar S>
double JerkPlan<S>::wanted_sq(const Cell<S>& cell, double most_sq) const noexcept {
    return to_double(SpeedCaps<S>(*limits_).wanted_sq(cell, from_double<S>(most_sq), steering_.ratio()));
}

template <Scalar S>
Pull JerkPlan<S>::take(UnderrunPolicy underrun, WorkBudget& work) noexcept {
    return source_.next(underrun, work, [this](const Cell<S>& cell, S cap_sq, S exit_sq) {
        const double most_sq = to_double(cap_sq);
        window_.append(cell, most_sq, wanted_sq(cell, most_sq), to_double(exit_sq));
        planned_all_ = false;
    });
}

template <Scalar S>
Pull JerkPlan<S>::fill(UnderrunPolicy underrun, WorkBudget& work) noexcept {
    window_.forget_travelled();
    Pull pull = Pull::item;
    while (!window_.full() && pull == Pull::item) {
        pull = take(underrun, work);
    }
    return pull;
}

// From stop to stop through every cell: for degenerate cells between cusps, and for a few cells if there is no better
// plan; after them there may be one. Returns its end.
template <Scalar S>
std::size_t JerkPlan<S>::rest_to_rest(std::size_t first, std::size_t end) noexcept {
    planned_ = end;
    if (end - first >= LegPlan::fewest_cells) {
        slow_legs_ += hops_ == 1 ? 1U : 0U;
        planned_ = smaller(end, first + hops_);
        hops_ = smaller(2 * hops_, window_.size());
    }
    for (std::size_t i = first; i < planned_; ++i) {
        window_.node(i).travel = Travel::rest_to_rest;
        window_.node(i + 1).b = 0.0;
    }
    return planned_;
}

// Begins to plan cells `first` to `end` as one motion to standstill there.
template <Scalar S>
void JerkPlan<S>::begin_leg(std::size_t first, std::size_t end) noexcept {
    leg_first_ = first;
    leg_end_ = end;
    leg_.begin(window_.state(first));
    for (std::size_t i = first; i < end; ++i) {
        leg_.add(window_.limits_of(i), window_.node(i).cap_sq, window_.node(i + 1).at_most_sq);
        if (i < planned_ && window_.node(first).b > 0.0) {
            leg_.know(window_.node(i).middle_sq);
        }
    }
    leg_.search();
    searching_ = true;
}

// `none`: the plan is as before.
template <Scalar S>
Search JerkPlan<S>::search_leg(WorkBudget& work) noexcept {
    Search search = Search::running;
    while (search == Search::running) {
        if (!work.take(static_cast<unsigned>(leg_.cells()))) {
            return Search::running;
        }
        search = leg_.step();
    }
    searching_ = false;
    if (search == Search::none) {
        ++slow_legs_;
        if (window_.node(leg_first_).b > 0.0 || !leg_.slow()) {
            return Search::none;
        }
    }
    for (std::size_t i = leg_first_; i < leg_end_; ++i) {
        JerkNode& node = window_.node(i);
        node.b = leg_.node(i - leg_first_).b;
        node.middle_sq = leg_.node(i - leg_first_).middle_sq;
        node.travel = Travel::curve;
    }
    window_.node(leg_end_).b = 0.0;
    return Search::found;
}

// How much of a leg that ends with the window is final: to about the middle, where it brakes least.
template <Scalar S>
std::size_t JerkPlan<S>::final_cells(std::size_t cells) const noexcept {
    const auto part = [cells](unsigned per_cent) {
        return larger<std::size_t>(1, cells * per_cent / 100U);
    };
    std::size_t best = part(50);
    auto least = largest<double>();
    for (std::size_t i = part(60); i >= part(35); --i) {
        const SpeedState state = window_.state(i);
        const double braking = -state.slope / square_root(state.b);
        if (braking < least) {
            least = braking;
            best = i;
        }
        if (!(braking > 0.0)) {
            break;
        }
    }
    return smaller(best, cells - 3);
}

// Plans legs from the front on, up to the middle of the window at least. false: the budget is spent.
template <Scalar S>
bool JerkPlan<S>::plan(WorkBudget& work) noexcept {
    const std::size_t half = (window_.size() + 1) / 2;
    planned_all_ = true;
    while (at_ < window_.size() && (at_ == 0 || at_ < half)) {
        std::size_t end = at_ + 1;
        while (end < window_.size() && !window_.cell(end - 1).stop_at_end) {
            ++end;
        }
        const bool stops = window_.cell(end - 1).stop_at_end || (ended_ && end == window_.size());
        if (!stops && at_ > 0) {
            break;
        }
        const bool rests = !(window_.node(at_).b > 0.0);
        if (!searching_ && stops && rests && StraightLeg<S>::is_straight(window_, at_, end)) {
            for (std::size_t i = at_; i < end; ++i) {
                window_.node(i).travel = Travel::line;
            }
            window_.node(end).b = 0.0;
            at_ = planned_ = end;
            hops_ = 1;
            continue;
        }
        if (!searching_ && end - at_ >= LegPlan::fewest_cells) {
            begin_leg(at_, end);
        }
        const Search search = searching_ ? search_leg(work) : Search::none;
        if (search == Search::running) {
            return false;
        }
        if (search == Search::found) {
            planned_ = end;
            at_ = stops ? end : final_cells(end);
            hops_ = 1;
        } else if (rests) {
            at_ = rest_to_rest(at_, end);
        } else { // the old plan goes on, and from a little farther there may be another
            SPLINEFEED_ASSERT(at_ == 0 && planned_ > 0);
            at_ = larger<std::size_t>(1, planned_ / 8);
            planned_all_ = false;
            break;
        }
    }
    committed_ = at_;
    planning_ = false;
    return true;
}

// The next profile segment of a straight move, as far as it lies in the front cell.
template <Scalar S>
void JerkPlan<S>::forward_step_on_line() noexcept {
    const double length = window_.node(0).length_mm;
    const double per_length = 1.0 / length;
    const JerkNode& node = window_.node(0);
    const bool last = node.travel == Travel::rest_to_rest || cell().stop_at_end; // the move ends in this cell
    const LinePiece piece = last ? line_.next() : line_.next(length - on_line_mm_);
    const S from = profile_segment_.stretch.from;
    on_line_mm_ = smaller(on_line_mm_ + piece.length_mm, length);
    const S one = from_integer<S>(1);
    const S reached = from_double<S>(on_line_mm_ * per_length);
    const bool to_end = last ? line_.done() : !(on_line_mm_ < length && reached < one);
    // The last phase of a move may be shorter than the last digit of a cell: one digit is reserved for it.
    const S before_end = one - scale2(one, last_digit_log2<S>);
    profile_segment_ = {};
    profile_segment_.stretch = {from, to_end ? one : smaller(reached, before_end)};
    profile_segment_.entry_sq = from_double<S>(piece.entry_mm_s * piece.entry_mm_s);
    profile_segment_.exit_sq = from_double<S>(piece.exit_mm_s * piece.exit_mm_s);
    profile_segment_.shape = SpeedShape::cubic;
    profile_segment_.duration_ms = from_double<S>(1e3 * piece.duration_s);
    profile_segment_.linear = from_double<S>(piece.linear);
    profile_segment_.quadratic = from_double<S>(piece.quadratic);
    profile_segment_.stops = to_end && line_.done();
}

template <Scalar S>
void JerkPlan<S>::forward_step() noexcept {
    const JerkNode& from = window_.node(0);
    const JerkNode& to = window_.node(1);
    if (!line_.done()) {
        forward_step_on_line();
        return;
    }
    profile_segment_ = {};
    on_line_mm_ = 0.0;
    if (from.travel != Travel::curve) {
        const StraightLeg<S> leg(window_);
        line_ = LineTravel(leg.from_rest());
        line_limits_ = leg.limits();
        forward_step_on_line();
        return;
    }
    const auto scalar = [](double x) {
        return from_double<S>(x);
    };
    profile_segment_.entry_sq = scalar(from.b);
    profile_segment_.exit_sq = scalar(to.b);
    const bool starts = !(profile_segment_.entry_sq > S{});
    const bool stops = !(profile_segment_.exit_sq > S{});
    profile_segment_.stops = stops;
    if (starts || stops) { // constant jerk, t = 3 L / v
        profile_segment_.shape = SpeedShape::cubic;
        profile_segment_.duration_ms = scalar(3e3 * from.length_mm / square_root(starts ? to.b : from.b));
        profile_segment_.linear = from_integer<S>(starts ? 0 : 3);
        profile_segment_.quadratic = from_integer<S>(starts ? 0 : -3);
    } else {
        profile_segment_.shape = SpeedShape::parabola;
        profile_segment_.middle_sq = scalar(from.middle_sq);
    }
}

template <Scalar S>
void JerkPlan<S>::want() noexcept {
    steering_.acknowledge();
    for (std::size_t i = 0; i < window_.size(); ++i) {
        JerkNode& node = window_.node(i);
        node.wanted_sq = wanted_sq(window_.cell(i), node.most_sq);
    }
}

template <Scalar S>
bool JerkPlan<S>::change_line(double from, const SpeedState& state) noexcept {
    StraightLeg<S> leg(window_, line_limits_);
    if (!(steering_.stops() ? leg.to_rest(from, state) : leg.to_end(from, state))) {
        return false;
    }
    line_ = LineTravel(leg.move());
    planned_ = committed_ = leg.cells();
    window_.node(planned_).b = 0.0; // an earlier plan may have been moving at its end inside the leg
    return true;
}

template <Scalar S>
bool JerkPlan<S>::change_curve(double from, const SpeedState& state) noexcept {
    JerkChange<S> change(window_, *limits_, from, state, planned_);
    if (!(steering_.stops() ? change.to_rest() : change.to_wanted())) {
        return false;
    }
    planned_ = change.planned();
    committed_ = change.changed();
    planned_all_ = false;
    return true;
}

// A change of the steering while the machine moves. If no other motion is found, the plan stays until there is one from
// where a later profile segment starts; the plan of a stop is travelled to its end, a standstill.
template <Scalar S>
bool JerkPlan<S>::answer(double from, const SpeedState& state) noexcept {
    if (state.b < JerkWindow<S>::slowest_sq) {
        return false; // later: it has just started, or is about to stop
    }
    want();
    window_.forget_travelled();
    if (halt_ > 0) {
        window_.cell(halt_ - 1).stop_at_end = false;
    }
    const bool stops = steering_.stops();
    const bool on_line = !line_.done();
    const double travelled_mm = from * window_.node(0).length_mm;
    const bool found = on_line ? change_line(from, state) : change_curve(from, state);
    unanswered_ = !found;
    if (!found) {
        if (halt_ > 0) {
            window_.cell(halt_ - 1).stop_at_end = true;
        }
        committed_ = stops ? planned_ : committed_;
        return false;
    }
    // Except on a straight move, the rest of the front cell becomes a cell of its own.
    on_line_mm_ = on_line ? travelled_mm : 0.0;
    profile_segment_.stretch.from = from_double<S>(on_line_mm_ / window_.node(0).length_mm);
    halt_ = 0;
    if (stops) {
        committed_ = planned_;
        if (!window_.cell(planned_ - 1).stop_at_end) {
            halt_ = planned_;
            Cell<S>& last = window_.cell(planned_ - 1);
            last.stop_at_end = true;
            last.position_at(from_integer<S>(1), last.end);
        }
    }
    return true;
}

template <Scalar S>
bool JerkPlan<S>::steer(const PlanState<S>& place) noexcept {
    const double from = to_double(place.fraction);
    const double left = 1.0 - from;
    if (line_.done() && (left < least_part || left * window_.node(0).length_mm < JerkWindow<S>::shortest_mm)) {
        return false; // it is tried again with the next profile segment
    }
    if (!answer(from, state_on(profile_segment_, window_.node(0).length_mm, from, to_double(place.time_share)))) {
        return false;
    }
    chosen_ = false;
    return true;
}

// Called before a profile segment is chosen.
template <Scalar S>
void JerkPlan<S>::follow_steering() noexcept {
    planning_ = searching_ = false;
    if (standing()) {
        unanswered_ = false;
        want();
        for (std::size_t i = 0; i < window_.size(); ++i) {
            JerkNode& node = window_.node(i);
            node.cap_sq = node.wanted_sq;
        }
        committed_ = planned_ = 0;
        planned_all_ = false;
    } else if (line_.done()) {
        const SpeedState state = window_.state(0); // the node moves
        static_cast<void>(answer(0.0, state));
    } else {
        const MoveState& state = line_.reached();
        static_cast<void>(answer(to_double(profile_segment_.stretch.from),
                                 {state.speed_mm_s * state.speed_mm_s, 2.0 * state.acceleration_mm_s2}));
    }
}

template <Scalar S>
Pull JerkPlan<S>::prepare(UnderrunPolicy underrun, WorkBudget& work) noexcept {
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
    if (steering_.pending() || (unanswered_ && !planning_)) {
        follow_steering();
    }
    if (committed_ == 0 && steering_.stops()) {
        committed_ = planned_;
    }
    if (committed_ == 0 && !planning_) {
        const Pull pull = fill(underrun, work);
        if (window_.size() == 0 || pull == Pull::busy || (pull == Pull::starved && underrun == UnderrunPolicy::wait)) {
            return pull;
        }
        if (planned_all_ && planned_ > 0) {
            // Later cells change the rest of the plan, except for a move that is planned as a whole.
            const bool in_part =
                pull == Pull::starved && !steering_.stops() && line_.done() && window_.node(0).travel == Travel::curve;
            committed_ = in_part ? 1 : planned_;
        } else {
            planning_ = true;
            ended_ = pull == Pull::finished;
            at_ = 0;
        }
    }
    if (planning_ && !plan(work)) {
        return Pull::busy;
    }
    forward_step();
    chosen_ = true;
    return Pull::item;
}

template <Scalar S>
void JerkPlan<S>::advance() noexcept {
    SPLINEFEED_ASSERT(chosen_);
    chosen_ = false;
    if (!(profile_segment_.stretch.to == from_integer<S>(1))) {
        profile_segment_.stretch.from = profile_segment_.stretch.to;
        return;
    }
    profile_segment_.stretch.from = S{};
    on_line_mm_ = 0.0;
    window_.pop();
    --committed_;
    --planned_;
    halt_ -= halt_ > 0 ? 1U : 0U;
}

template <Scalar S>
void JerkPlan<S>::rest_at(S /*fraction*/) noexcept {
    SPLINEFEED_ASSERT(false); // it ends where it says
}

template <Scalar S>
bool JerkPlan<S>::standing() const noexcept {
    return !chosen_ && line_.done() && !(window_.node(0).b > 0.0);
}

template <Scalar S>
void JerkPlan<S>::clear() noexcept {
    SPLINEFEED_ASSERT(standing());
    source_.forget();
    window_.clear();
    committed_ = planned_ = halt_ = 0;
    hops_ = 1;
    on_line_mm_ = 0.0;
    profile_segment_ = {};
    planned_all_ = unanswered_ = planning_ = searching_ = false;
    steering_.start();
}

template class JerkPlan<double>;
template class JerkPlan<float>;
template class JerkPlan<Fixed>;

} // namespace splinefeed
