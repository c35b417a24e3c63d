// SPDX-License-Identifier: MIT
// BackwardPass: from which speed at each node of a window the machine can still stop at the window's end. Derivation:
// feed_plan.cpp.
#pragma once

#include "splinefeed/base/work_budget.hpp"
#include "splinefeed/s3_feed_plan/acceleration/cell_window.hpp"
#include "splinefeed/s3_feed_plan/acceleration/speed_caps.hpp"

namespace splinefeed {

/// Goes over a window from its end to its front, in as many parts as its caller wants. In every cell that it has
/// passed, `entry_sq` is the largest entry from which the machine's K after the cell can be reached. `exit_sq` is the
/// K of the steering there. While the pass runs, only the front cell may leave
/// the window. Cost: a step of the budget for each cell,
/// and four for each part of the search for the peak of a cell that comes for the first time. A step is two products
/// and sums for each axis, and as much again under a reduced feed.
template <Scalar S>
class BackwardPass {
public:
    /// @param wish  of the operator
    /// @param open_end  the speed at the end is free: a motion that follows need not stop there
    void begin(const CellWindow<S>& window, const FeedWish<S>& wish, bool open_end) noexcept;
    /// false: the budget is spent; call again. @pre running(), the window of begin()
    bool run(CellWindow<S>& window, const MotionLimits<S>& limits, WorkBudget& work) noexcept;
    void cancel() noexcept { running_ = false; }
    /// The front cell has left the window.
    void pop() noexcept {
        cells_ -= cells_ > 0 ? 1U : 0U;
        last_final_ -= last_final_ > 0 ? 1U : 0U;
    }

    [[nodiscard]] bool running() const noexcept { return running_; }
    /// The wish of the operator that the pass counts with.
    [[nodiscard]] const FeedWish<S>& wish() const noexcept { return wish_; }
    [[nodiscard]] bool open_end() const noexcept { return open_end_; }
    /// The last node whose K no longer window can raise, or 0. @pre the pass is complete
    [[nodiscard]] std::size_t last_final() const noexcept { return last_final_; }

private:
    static constexpr unsigned peak_steps = 4;

    void visit(CellWindow<S>& window, const MotionLimits<S>& limits) noexcept;

    std::size_t cells_ = 0; // that are still to be visited
    std::size_t last_final_ = 0;
    FeedWish<S> wish_{};
    S machine_sq_{};      // K of the machine at the node behind the next cell
    S override_sq_{};     // K of the steering there
    CapLine<S> wanted_{}; // what is wanted in the next cell
    bool open_end_ = false;
    bool begun_ = false; // a cell was visited
    bool running_ = false;
};

} // namespace splinefeed
