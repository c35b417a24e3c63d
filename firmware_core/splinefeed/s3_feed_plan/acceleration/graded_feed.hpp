// SPDX-License-Identifier: MIT
// GradedFeed: the cells of an acceleration-limited plan for a plan that limits the jerk as well, cut where the speed is
// low.
#pragma once

#include "splinefeed/s2_arc_length/cell_part.hpp"
#include "splinefeed/s3_feed_plan/acceleration/feed_plan.hpp"

namespace splinefeed {

/// Delivers the cells of a FeedPlan to a plan that limits the jerk, in parts that are short where the speed is low.
/// Without that the cells beside a short bend would keep the low speed of the bend. Memory: a few words. Cost per part:
/// two roots, two divisions for each axis; two roots and two divisions for each halving, and cutting the part if it is
/// not a whole cell.
template <Scalar S>
class GradedFeed {
public:
    /// `source` and `limits` must outlive it. @param longest  length of a part at most, in sqrt(v^3 / J) or v^2 / (2 A)
    GradedFeed(FeedPlan<S>& source, const MotionLimits<S>& limits, S longest) noexcept
        : source_(&source), limits_(&limits), longest_(longest) {
        source.lead();
    }

    /// Calls `take(cell, cap_sq, exit_sq)` with the next part of the path if there is one. `cap_sq` is the largest v^2
    /// anywhere in the part that the machine allows (SpeedCaps::bent_cap_sq), `exit_sq` the acceleration-limited v^2 at
    /// its end. `busy`: the budget is spent.
    template <class Take>
    Pull next(UnderrunPolicy underrun, WorkBudget& work, Take&& take) noexcept {
        if (const Pull pull = prepare(underrun, work); pull != Pull::item) {
            return pull;
        }
        const Cell<S>& cell = source_->cell();
        const CellInterval<S> part = next_part(cell);
        const S exit_sq = speed_sq_at(part.to);
        if (part.whole()) {
            take(cell, SpeedCaps<S>(*limits_).bent_cap_sq(cell), exit_sq);
        } else {
            take_part(cell, part, exit_sq, take);
        }
        leave(part);
        return Pull::item;
    }
    /// The plan that the cells come from.
    [[nodiscard]] const FeedPlan<S>& plan() const noexcept { return *source_; }
    /// Forgets every cell.
    void forget() noexcept {
        from_ = S{};
        source_->forget();
    }

private:
    /// Apart: the cell of the part does not lie on the stack below prepare().
    template <class Take>
    [[gnu::noinline]] void take_part(const Cell<S>& cell, const CellInterval<S>& part, S exit_sq, Take& take) noexcept {
        const Cell<S> cut = part_of(cell, part);
        take(cut, SpeedCaps<S>(*limits_).bent_cap_sq(cut), exit_sq);
    }
    Pull prepare(UnderrunPolicy underrun, WorkBudget& work) noexcept;
    [[nodiscard]] CellInterval<S> next_part(const Cell<S>& cell) const noexcept;
    [[nodiscard]] S longest_of(const CellInterval<S>& part, S jerk, S acceleration) const noexcept;
    [[nodiscard]] S speed_sq_at(S fraction) const noexcept;
    void leave(const CellInterval<S>& part) noexcept;

    FeedPlan<S>* source_;
    const MotionLimits<S>* limits_;
    S longest_;
    S from_{}; // where the next part of the front cell begins
};

} // namespace splinefeed
