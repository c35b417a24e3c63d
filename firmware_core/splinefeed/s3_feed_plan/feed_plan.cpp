// SPDX-License-Identifier: MIT
//
// b = v^2 = (ds/dt)^2 is linear in s within a cell. Which pairs of b at its ends keep every axis within its
// acceleration is a convex polygon P that holds (0, 0) (acceleration_bound.cpp). Time-optimal by reachability
// (TOPP-RA):
//
// - backward: K_i, the largest b at node i from which rest at the end of the window can be reached: the largest entry
// of P
//   with an exit up to K_i+1, and no larger than the caps beside the node. As (0, 0) is in P, all of 0 ... K_i will do.
// - forward: the largest exit that P allows for the entry and K_i+1. There is one, because the entry is at most K_i.
//
// K_i grows with K_i+1 until it is at a cap or the entry at the peak of P. A longer window can only raise K; so a node
// where one of the two holds is final, and with it every K before it: what lies before is equal to the plan with an
// unlimited window. The window is committed up to the last such node. Where an earlier part is committed without being
// final, K of its last node can only rise afterwards: a stop stays within reach.
#include "splinefeed/s3_feed_plan/feed_plan.hpp"

#include "splinefeed/s3_feed_plan/axis_velocity.hpp"
#include "splinefeed/s3_feed_plan/feed_share.hpp"

namespace splinefeed {

namespace {

// Slowest speed a cap may ask for away from stops, 1e-3 mm/s squared: below, time per cell would lose its meaning in
// Fixed. At this speed an axis feels less than its smallest limit for any curvature below 1e5 /mm.
constexpr double slowest_sq = 1e-6;

} // namespace

template <Scalar S>
FeedPlan<S>::FeedPlan(ArcLength<S>& source, const MotionLimits<S>& limits, std::span<PlannedCell<S>> window) noexcept
    : source_(&source), limits_(limits), window_(window) {
    SPLINEFEED_ASSERT(window.size() >= smallest_window);
}

// Cap of a cell. This is the one place where a limit of the speed is stated.
template <Scalar S>
void FeedPlan<S>::bound(PlannedCell<S>& planned) const noexcept {
    const Cell<S>& cell = planned.cell;
    const S feed =
        cell.feed_mm_s > S{} ? smaller(limits_.usable_feed(cell.feed_mm_s), limits_.feed_mm_s) : limits_.feed_mm_s;
    // Whatever the override, the feed keeps the block's own maximum.
    const S most = cell.max_feed_mm_s > S{} ? smaller(limits_.usable_feed(cell.max_feed_mm_s), feed) : feed;
    // The feed counts the linear axes; the others follow as fast as their own limits allow.
    S speed = most;
    if (limits_.mixed) {
        speed = smaller(quotient_or_max(most, feed_share(cell, limits_)), limits_.path_mm_s);
    }
    for (unsigned k = 0; k < static_cast<unsigned>(limits_.axes); ++k) {
        const S velocity = axis_velocity(cell, limits_, k);
        if (cell.tangent_max[k] * speed > velocity) {
            speed = velocity / cell.tangent_max[k];
        }
    }
    if (cell.direction_noise * speed > limits_.jump_mm_s) {
        speed = limits_.jump_mm_s / cell.direction_noise;
    }
    S cap = speed * speed;
    S reach = cap;
    const S twice = cell.length_mm + cell.length_mm;
    for (unsigned k = 0; k < static_cast<unsigned>(limits_.axes); ++k) {
        const S limit = smaller(limits_.acceleration_mm_s2[k], limits_.braking_mm_s2[k]);
        const S turn = twice * cell.curvature_max[k];
        if (turn > literal<S>(Cell<S>::sharp_turn)) {
            cap = smaller(cap, scale2(limit, -1) / cell.curvature_max[k]);
        }
        reach = smaller(reach, quotient_or_max(twice * limit, cell.tangent_max[k] + turn));
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
    planned.reach_from_rest = smaller(reach, planned.cap_sq);
}

// Backward over all that is not committed, forward from it, then commits.
template <Scalar S>
void FeedPlan<S>::plan(bool ended) noexcept {
    // exit_sq holds K of the node behind each cell, entry_sq the largest entry with which that can be reached
    std::size_t last_final = committed_;
    S beyond{}; // at rest
    for (std::size_t i = size_; i-- > committed_;) {
        PlannedCell<S>& here = at(i);
        here.exit_sq = beyond;
        S cap = here.cap_sq;
        if (i > committed_) {
            const PlannedCell<S>& before = at(i - 1);
            cap = before.cell.stop_at_end ? S{} : smaller(cap, before.cap_sq);
        }
        const bool at_peak = beyond >= here.peak.exit_sq;
        const S reached = at_peak ? here.peak.entry_sq
                                  : AccelerationBound<S>(here.cell, limits_).largest_entry(beyond, here.peak.entry_sq);
        here.entry_sq = reached;
        if ((at_peak || reached >= cap) && last_final == committed_) {
            last_final = i;
        }
        beyond = smaller(reached, cap);
    }
    std::size_t target = size_;
    if (!ended) {
        const std::size_t quarter = committed_ + (size_ - committed_ + 3) / 4;
        if (last_final < quarter) {
            ++window_limited_;
        }
        target = last_final < quarter ? quarter : last_final;
    }
    for (; committed_ < target; ++committed_) {
        PlannedCell<S>& here = at(committed_);
        // P is convex: what is reached from here.entry_sq tells what is reached from less. Where an axis has next to no
        // inertia, the largest exit depends on the last digits of the entry, and this does not.
        const S share = entry_sq_ < here.entry_sq ? entry_sq_ / here.entry_sq : from_integer<S>(1);
        const S reached = share * smaller(here.peak.exit_sq, here.exit_sq);
        here.entry_sq = entry_sq_;
        here.exit_sq = larger(reached, AccelerationBound<S>(here.cell, limits_).largest_exit(entry_sq_, here.exit_sq));
        entry_sq_ = here.exit_sq;
    }
}

template <Scalar S>
Pull FeedPlan<S>::prepare() noexcept {
    if (committed_ > 0) {
        return Pull::item;
    }
    bool ended = false;
    while (size_ < window_.size() && !ended) {
        PlannedCell<S>& slot = at(size_);
        const Pull pull = source_->next(slot.cell);
        if (pull == Pull::starved) {
            return Pull::starved;
        }
        if (pull == Pull::item) {
            bound(slot);
            slot.peak = AccelerationBound<S>(slot.cell, limits_).peak(slot.cap_sq);
            if (slot.cell.stop_before &&
                size_ > 0) { // the newest cell is never committed before its successor is known
                Cell<S>& before = at(size_ - 1).cell;
                before.stop_at_end = true;
                before.end = slot.cell.origin;
            }
            ++size_;
        }
        ended = pull == Pull::finished;
    }
    if (size_ == 0) {
        return Pull::finished;
    }
    plan(ended);
    return Pull::item;
}

template <Scalar S>
void FeedPlan<S>::pop() noexcept {
    SPLINEFEED_ASSERT(committed_ > 0);
    head_ = (head_ + 1) % window_.size();
    --size_;
    --committed_;
}

template class FeedPlan<double>;
template class FeedPlan<float>;
template class FeedPlan<Fixed>;

} // namespace splinefeed
