// SPDX-License-Identifier: MIT
//
// With b = v^2 = (ds/dt)^2 and a = d2s/dt2, db/ds = 2 a; b is linear in s within a cell of length L, so
// a = (b1 - b0) / (2 L). An axis accelerates by q' a + q'' b. With cell maxima Q1 >= |q'|, Q2 >= |q''|,
//
//   |q' a + q'' b| <= Q1 |b1 - b0| / (2 L) + Q2 max(b0, b1) <= A
//
// holds at every point of the cell if it holds with the faster end on the right. Solved for the faster end b1:
//
//   b1 <= (2 L A + Q1 b0) / (Q1 + 2 L Q2) = reach + carry b0                                    for every axis
//
// which grows with b0: the largest feasible profile is found exactly by one backward and one forward pass (a lattice).
// A node where the backward value reaches its cap cannot be raised by anything behind it: what lies before it is final,
// equal to the plan with an unlimited window. The window is committed up to the last such node.
#include "splinefeed/s3_feed_plan/feed_plan.hpp"

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

// Caps and reach of a cell. This is the one place where a limit of the speed is stated.
template <Scalar S>
void FeedPlan<S>::bound(PlannedCell<S>& planned) const noexcept {
    const Cell<S>& cell = planned.cell;
    const S feed =
        cell.feed_mm_s > S{} ? smaller(limits_.usable_feed(cell.feed_mm_s), limits_.feed_mm_s) : limits_.feed_mm_s;
    S speed = feed;
    for (unsigned k = 0; k < static_cast<unsigned>(limits_.axes); ++k) {
        if (cell.tangent_max[k] * speed > limits_.velocity_mm_s[k]) {
            speed = limits_.velocity_mm_s[k] / cell.tangent_max[k];
        }
    }
    if (cell.direction_noise * speed > limits_.jump_mm_s) {
        speed = limits_.jump_mm_s / cell.direction_noise;
    }
    S cap = speed * speed;
    const S twice = cell.length_mm + cell.length_mm;
    for (unsigned k = 0; k < static_cast<unsigned>(limits_.axes); ++k) {
        const S limit = limits_.acceleration_mm_s2[k];
        cap = smaller(cap, quotient_or_max(limit, cell.curvature_max[k]));
        const S inertia = cell.tangent_max[k] + twice * cell.curvature_max[k];
        planned.reach[k] = quotient_or_max(twice * limit, inertia);
        planned.carry[k] = inertia > S{} ? smaller(cell.tangent_max[k] / inertia, from_integer<S>(1)) : S{};
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
    // Beyond the cap a reach means nothing; bounded by it, the passes cannot overflow.
    for (unsigned k = 0; k < static_cast<unsigned>(limits_.axes); ++k) {
        planned.reach[k] = smaller(planned.reach[k], planned.cap_sq);
    }
    planned.reach_from_rest = reachable(planned, S{});
}

template <Scalar S>
S FeedPlan<S>::reachable(const PlannedCell<S>& planned, S from_sq) const noexcept {
    S best = planned.cap_sq;
    for (unsigned k = 0; k < static_cast<unsigned>(limits_.axes); ++k) {
        best = smaller(best, planned.reach[k] + planned.carry[k] * from_sq);
    }
    return best;
}

// Backward over all that is not committed, forward from it, then commits.
template <Scalar S>
void FeedPlan<S>::plan(bool ended) noexcept {
    // exit_sq holds the backward value of the node behind each cell
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
        const S reached = reachable(here, beyond);
        if (reached >= cap && last_final == committed_) {
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
        here.entry_sq = entry_sq_;
        here.exit_sq = smaller(here.exit_sq, reachable(here, entry_sq_));
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
