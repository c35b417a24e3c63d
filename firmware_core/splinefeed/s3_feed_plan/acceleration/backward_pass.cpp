// SPDX-License-Identifier: MIT
#include "splinefeed/s3_feed_plan/acceleration/backward_pass.hpp"

#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

template <Scalar S>
void BackwardPass<S>::begin(const CellWindow<S>& window, const FeedWish<S>& wish, bool open_end) noexcept {
    cells_ = window.size();
    last_final_ = 0;
    wish_ = wish;
    machine_sq_ = override_sq_ = S{}; // standstill
    open_end_ = open_end;
    begun_ = false;
    running_ = true;
}

template <Scalar S>
bool BackwardPass<S>::run(CellWindow<S>& window, const MotionLimits<S>& limits, WorkBudget& work) noexcept {
    while (cells_ > 0) {
        PlannedCell<S>& here = window.at(cells_ - 1);
        while (!here.peak.known()) {
            if (!work.take(peak_steps)) {
                return false;
            }
            AccelerationBound<S>(here.cell, limits).approach_peak(here.cap, here.peak);
        }
        if (!work.take()) {
            return false;
        }
        visit(window, limits);
    }
    running_ = false;
    return true;
}

template <Scalar S>
void BackwardPass<S>::visit(CellWindow<S>& window, const MotionLimits<S>& limits) noexcept {
    const SpeedCaps<S> caps(limits);
    const std::size_t i = --cells_;
    PlannedCell<S>& here = window.at(i);
    const CapLine<S> wanted = begun_ ? wanted_ : caps.wanted(here.cell, here.cap, wish_);
    if (!begun_ && open_end_ && !here.cell.stop_at_end) {
        machine_sq_ = here.cap.exit_sq;
        override_sq_ = wanted.exit_sq;
    }
    begun_ = true;
    S machine_cap = here.cap.entry_sq;
    S override_cap = wanted.entry_sq;
    if (i > 0) {
        const PlannedCell<S>& before = window.at(i - 1);
        const bool stop = before.cell.stop_at_end;
        machine_cap = stop ? S{} : smaller(machine_cap, before.cap.exit_sq);
        wanted_ = caps.wanted(before.cell, before.cap, wish_);
        override_cap = stop ? S{} : smaller(override_cap, wanted_.exit_sq);
    }
    const auto reached_from = [&](S beyond, S at_most) {
        return beyond >= here.peak.smallest_exit_sq
                   ? at_most
                   : AccelerationBound<S>(here.cell, limits).largest_entry(beyond, at_most);
    };
    const S machine_reach = reached_from(machine_sq_, here.peak.entry_sq);
    const bool alike = override_sq_ == machine_sq_ && wanted == here.cap;
    const S override_reach =
        alike ? machine_reach : reached_from(override_sq_, smaller(wanted.entry_sq, here.peak.entry_sq));
    if ((override_sq_ >= here.peak.smallest_exit_sq || override_reach >= override_cap) && last_final_ == 0) {
        last_final_ = i;
    }
    here.entry_sq = machine_reach;
    here.exit_sq = override_sq_;
    machine_sq_ = smaller(machine_reach, machine_cap);
    override_sq_ = smaller(override_reach, override_cap);
}

SPLINEFEED_INSTANTIATE_CLASS(BackwardPass)

} // namespace splinefeed
