// SPDX-License-Identifier: MIT
//
// A leg that ends at a stop is final; of a leg that ends with the window, about the first half is committed. The rest
// is planned again when more of the path is known. Its old plan is kept. If no new one is found from the state at the
// end of the committed part, the old one goes on: it ends at standstill.
#include "splinefeed/s3_feed_plan/jerk/window_plan.hpp"

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/s3_feed_plan/jerk/straight_leg.hpp"

namespace splinefeed {

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
    const auto part = [cells](unsigned per_cent) {
        return larger<std::size_t>(1, cells * per_cent / 100U);
    };
    std::size_t best = part(50);
    auto least = largest<double>();
    for (std::size_t i = part(60); i >= part(35); --i) {
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
        const bool stops = window_->cell(end - 1).stop_at_end || (ended_ && end == window_->size());
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
        leg_cells_ = 0;
        if (search == Search::found) {
            planned_ = end;
            at_ = stops ? end : at_ + final_cells(at_, end - at_);
            hops_ = 1;
        } else if (rests) {
            at_ = rest_to_rest(at_, end);
        } else { // the old plan goes on, and from a little farther there may be another; else it goes on to its end
            SPLINEFEED_ASSERT(at_ == first_ && planned_ > first_);
            at_ = state_ == State::goes_on ? planned_ : at_ + larger<std::size_t>(1, (planned_ - first_) / 8);
            after = State::goes_on;
            break;
        }
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
