// SPDX-License-Identifier: MIT
//
// A leg that ends at a stop is final; of a leg that ends with the window, about the first half is committed. The rest
// is planned again when more of the path is known. Where it brakes there only because the window ends, later legs are
// not faster than that, for each mm that they know ahead: the speed would rise and fall with each leg. Its old plan is
// kept. If no new one is found from the state at the end of the committed part, the old one goes on: it ends at
// standstill.
#include "splinefeed/s3_feed_plan/jerk/window_plan.hpp"

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/s3_feed_plan/jerk/straight_leg.hpp"

namespace splinefeed {

namespace {

// Per cent of the cells of a leg that are final, if it ends with the window: where that is what binds, fewer leave more
// of it ahead.
constexpr unsigned first_final = 35;
constexpr unsigned first_final_bound = 22;
constexpr unsigned last_final = 60;
constexpr double least_growth = 1.0 / 512; // of what the window is known to cover
constexpr double near_cap = 0.98;          // so near, the cap counts as what binds

constexpr std::size_t per_cent_of(std::size_t cells, unsigned part) noexcept {
    return larger<std::size_t>(1, cells * part / 100U);
}

} // namespace

// From stop to stop through every cell: for degenerate cells between cusps, and for a few cells if there is no better
// plan; after them there may be one. Returns its end.
template <Scalar S, Floating R>
std::size_t WindowPlan<S, R>::rest_to_rest(std::size_t first, std::size_t end) noexcept {
    planned_ = end;
    if (end - first >= LegPlan<R>::fewest_cells) {
        planned_ = smaller(end, first + hops_);
        hops_ = smaller(2 * hops_, window_->size());
    }
    for (std::size_t i = first; i < planned_; ++i) {
        window_->node(i).travel = Travel::rest_to_rest;
        window_->node(i + 1).b = 0.0;
    }
    return planned_;
}

// Takes the next cell into the leg; after the last one the search begins.
template <Scalar S, Floating R>
void WindowPlan<S, R>::add_cell() noexcept {
    const std::size_t i = at_ + leg_->cells();
    leg_->add(window_->limits_of(i), window_->node(i + 1).at_most_sq);
    if (i < planned_ && window_->node(at_).b > 0.0) {
        leg_->know(static_cast<R>(window_->node(i).middle_sq));
    }
    if (leg_->cells() == leg_cells_) {
        if (!stops_at(at_ + leg_cells_)) {
            most_sq_ = covered_.by(ahead_mm(at_ + per_cent_of(leg_cells_, first_final_bound)));
            leg_->limit(most_sq_);
        }
        leg_->search();
    }
}

// `none`: the plan is as before.
template <Scalar S, Floating R>
Search WindowPlan<S, R>::search_leg(WorkBudget& work) noexcept {
    Search search = Search::running;
    while (leg_->cells() < leg_cells_) {
        if (!work.take()) {
            return search;
        }
        add_cell();
    }
    while (search == Search::running) {
        if (!work.take(leg_->step_work())) {
            return Search::running;
        }
        search = leg_->step();
    }
    ++searched_legs_;
    if (search == Search::none) {
        ++slow_legs_;
        if (window_->node(at_).b > 0.0 || !leg_->slow()) {
            return Search::none;
        }
    }
    leg_->each_cell([&](std::size_t i, double b, double middle_sq) {
        JerkNode<R>& node = window_->node(at_ + i);
        node.b = b;
        node.middle_sq = middle_sq;
        node.travel = Travel::curve;
    });
    window_->node(at_ + leg_cells_).b = 0.0;
    return Search::found;
}

// How much of a leg of so many cells from `first` on, which ends with the window, is final: to about the middle, where
// it brakes least, and so that a leg is left behind it; one cell at least.
template <Scalar S, Floating R>
std::size_t WindowPlan<S, R>::final_cells(std::size_t first, std::size_t cells) const noexcept {
    std::size_t best = per_cent_of(cells, 50);
    auto least = largest<double>();
    const std::size_t earliest = per_cent_of(cells, covered_.binds() ? first_final_bound : first_final);
    for (std::size_t i = per_cent_of(cells, last_final); i >= earliest; --i) {
        const SpeedState state = window_->state(first + i);
        const double braking = -state.slope / square_root(state.b);
        if (braking < least) {
            least = braking;
            best = i;
        }
        if (!(braking > 0.0)) {
            break;
        }
    }
    return larger<std::size_t>(1, smaller(best, cells - LegPlan<R>::fewest_cells));
}

template <Scalar S, Floating R>
bool WindowPlan<S, R>::stops_at(std::size_t end) const noexcept {
    return window_->cell(end - 1).stop_at_end || (ended_ && end == window_->size());
}

template <Scalar S, Floating R>
R WindowPlan<S, R>::ahead_mm(std::size_t first) const noexcept {
    R ahead{};
    for (std::size_t i = first; i < at_ + leg_cells_; ++i) {
        ahead += window_->node(i).length_mm;
    }
    return ahead;
}

// What a leg that ends with the window shows. It brakes at the end of its final part although the path would let it go
// on as fast: the look-ahead binds. Where nothing else binds in all of the leg, later ones are not faster than that,
// for what they know ahead.
template <Scalar S, Floating R>
void WindowPlan<S, R>::look_ahead(std::size_t committed) noexcept {
    const SpeedState state = window_->state(committed);
    const R b = static_cast<R>(state.b);
    R most{};
    R least = largest<R>();
    R least_behind = largest<R>();
    for (std::size_t i = at_; i < at_ + leg_cells_; ++i) {
        const JerkNode<R>& node = window_->node(i);
        most = larger(most, static_cast<R>(node.b));
        R& at_most = i < committed ? least : least_behind;
        at_most = smaller(at_most, smaller(node.cap_sq, window_->node(i + 1).at_most_sq));
    }
    const bool free = !(smaller(least, least_behind) < most);
    const bool brakes = state.slope < 0.0 && !(least_behind < b);
    window_limited_ += brakes || (free && b > R(near_cap) * most_sq_) ? 1 : 0;
    if (!free) {
        covered_ = {};
    } else if (brakes) {
        covered_ = {b, ahead_mm(committed), R(least_growth)};
    } else {
        covered_.b += covered_.growth * covered_.b;
        covered_.growth = smaller(R(2) * covered_.growth, R(1));
    }
}

// Plans legs from the front on, up to the middle of the window at least. false: the budget is spent.
template <Scalar S, Floating R>
bool WindowPlan<S, R>::run(WorkBudget& work) noexcept {
    const std::size_t half = first_ + (window_->size() - first_ + 1) / 2;
    State after = State::complete;
    while (at_ < window_->size() && (at_ == first_ || at_ < half)) {
        const std::size_t before = at_;
        std::size_t end = at_ + 1;
        while (end < window_->size() && !window_->cell(end - 1).stop_at_end) {
            ++end;
        }
        const bool stops = stops_at(end);
        if (!stops && at_ > first_) {
            break;
        }
        const bool rests = !(window_->node(at_).b > 0.0);
        if (leg_cells_ == 0 && stops && rests && StraightLeg<S, R>::is_straight(*window_, at_, end)) {
            for (std::size_t i = at_; i < end; ++i) {
                window_->node(i).travel = Travel::line;
            }
            window_->node(end).b = 0.0;
            at_ = planned_ = end;
            hops_ = 1;
            continue;
        }
        if (leg_cells_ == 0 && end - at_ >= LegPlan<R>::fewest_cells) { // as one motion to standstill
            leg_cells_ = end - at_;
            leg_->begin(window_->state(at_));
        }
        const Search search = leg_cells_ > 0 ? search_leg(work) : Search::none;
        if (search == Search::running) {
            return false;
        }
        if (search == Search::found) {
            planned_ = end;
            std::size_t final_end = end;
            if (!stops) {
                final_end = at_ + final_cells(at_, end - at_);
                look_ahead(final_end);
            }
            at_ = final_end;
            hops_ = 1;
        } else if (rests) {
            at_ = rest_to_rest(at_, end);
        } else { // the old plan goes on, and from a little farther there may be another; else it goes on to its end
            SPLINEFEED_ASSERT(at_ == first_ && planned_ > first_);
            at_ = state_ == State::goes_on ? planned_ : at_ + larger<std::size_t>(1, (planned_ - first_) / 8);
            after = State::goes_on;
            break;
        }
        leg_cells_ = 0;
        SPLINEFEED_ASSERT(at_ > before);
    }
    committed_ = at_;
    state_ = after;
    cancel();
    return true;
}

#define SPLINEFEED_INSTANTIATE(S, R) template class WindowPlan<S, R>;
SPLINEFEED_EACH_JERK_PLAN(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
