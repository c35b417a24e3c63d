// SPDX-License-Identifier: MIT
// PlannedTrajectory: the pipeline for a machine, with the planner that its limits need, and its memory.
#pragma once

#include "splinefeed/acceleration_planner.hpp"
#include "splinefeed/bounded_planner.hpp"
#include "splinefeed/optimal_planner.hpp"
#include "splinefeed/trajectory.hpp"

#include <algorithm>
#include <optional>
#include <vector>

namespace splinefeed::host {

template <Scalar S>
class PlannedTrajectory {
public:
    /// An OptimalPlanner looks a quarter as far ahead: what it plans far ahead is planned again later.
    static constexpr std::size_t cells_an_optimal_cell = 4;

    /// All arguments must outlive it.
    PlannedTrajectory(CurveSource<S>& curve, const MotionLimits<S>& limits, std::size_t window_cells)
        : window_(feed_cells(limits, window_cells)) {
        if (!limits.jerk_limited) {
            trajectory_ = *Trajectory<S>::make(curve, limits, acceleration_.emplace(window_));
        } else if (limits.jerk_tier == JerkTier::bounded) {
            smooth_cells_.resize(std::max(window_cells, SmoothPlan<S>::smallest_window));
            places_.resize(SmoothSampler<S>::places_for(limits));
            trajectory_ = *Trajectory<S>::make(curve, limits,
                                               bounded_.emplace(window_, SmoothStorage<S>{smooth_cells_, places_}));
        } else {
            const std::size_t cells = std::max(window_cells / cells_an_optimal_cell, JerkPlan<S>::smallest_window);
            cells_.resize(cells + std::min(cells / 3, JerkWindow<S>::most_spare)); // a quarter of all is kept free
            nodes_.resize(cells_.size() + 1);
            scratch_.resize(nodes_.size());
            trajectory_ = *Trajectory<S>::make(curve, limits,
                                               optimal_.emplace(window_, JerkStorage<S>{cells_, nodes_, scratch_}));
        }
    }
    PlannedTrajectory(const PlannedTrajectory&) = delete;
    PlannedTrajectory& operator=(const PlannedTrajectory&) = delete;

    [[nodiscard]] Trajectory<S>& trajectory() noexcept { return trajectory_; }
    [[nodiscard]] const Trajectory<S>& trajectory() const noexcept { return trajectory_; }
    /// Null if the plan is acceleration-limited or averaged.
    [[nodiscard]] const JerkPlan<S>* jerk_plan() const noexcept { return optimal_ ? &optimal_->plan() : nullptr; }
    /// Memory of the planning, without that of the segment stream.
    [[nodiscard]] std::size_t bytes() const noexcept {
        return (acceleration_ ? sizeof *acceleration_
                : bounded_    ? sizeof *bounded_
                              : sizeof *optimal_) -
               sizeof(SegmentStream<S>) + window_.size() * sizeof(PlannedCell<S>) +
               smooth_cells_.size() * sizeof(SmoothCell<S>) + places_.size() * sizeof(PathPosition) +
               cells_.size() * sizeof(Cell<S>) + nodes_.size() * (sizeof(JerkNode) + sizeof(LegNode<double>));
    }

private:
    /// Number of cells of the feed plan. With averaged motion, the window of that plan looks far ahead instead.
    [[nodiscard]] static std::size_t feed_cells(const MotionLimits<S>& limits, std::size_t window_cells) {
        const bool averaged = limits.jerk_limited && limits.jerk_tier == JerkTier::bounded;
        return averaged ? std::max(window_cells / 2, FeedPlan<S>::smallest_window) : window_cells;
    }

    std::vector<PlannedCell<S>> window_;
    std::vector<Cell<S>> cells_;
    std::vector<JerkNode> nodes_;
    std::vector<LegNode<double>> scratch_;
    std::vector<SmoothCell<S>> smooth_cells_;
    std::vector<PathPosition> places_;
    std::optional<AccelerationPlanner<S>> acceleration_; // one of the three
    std::optional<BoundedPlanner<S>> bounded_;
    std::optional<OptimalPlanner<S>> optimal_;
    Trajectory<S> trajectory_;
};

} // namespace splinefeed::host
