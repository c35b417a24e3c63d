// SPDX-License-Identifier: MIT
// Planner: the pipeline for a machine, and the memory that it plans in.
#pragma once

#include "splinefeed/jerk_trajectory.hpp"
#include "splinefeed/smooth_trajectory.hpp"

#include <algorithm>
#include <memory>
#include <vector>

namespace splinefeed::host {

template <Scalar S>
class Planner {
public:
    /// A JerkPlan looks a quarter as far: what it plans far ahead is planned again from nearer.
    static constexpr std::size_t cells_a_jerk_cell = 4;

    /// All arguments must outlive it.
    Planner(CurveSource<S>& curve, const MotionLimits<S>& limits, std::size_t window_cells)
        : window_(feed_cells(limits, window_cells)) {
        if (!limits.jerk_limited) {
            plain_ = std::make_unique<Trajectory<S>>(curve, limits, window_);
            return;
        }
        if (limits.jerk_tier == JerkTier::bounded) {
            smooth_cells_.resize(std::max(window_cells, SmoothPlan<S>::smallest_window));
            places_.resize(SmoothSampler<S>::places_for(limits));
            smooth_ =
                std::make_unique<SmoothTrajectory<S>>(curve, limits, window_, SmoothStorage<S>{smooth_cells_, places_});
            return;
        }
        const std::size_t cells = std::max(window_cells / cells_a_jerk_cell, JerkPlan<S>::smallest_window);
        cells_.resize(cells + std::min(cells / 3, JerkWindow<S>::most_spare)); // a quarter of all is kept free
        nodes_.resize(JerkStorage<S>::nodes_for(cells_.size()));
        jerk_limited_ = std::make_unique<JerkTrajectory<S>>(curve, limits, window_, JerkStorage<S>{cells_, nodes_});
    }

    [[nodiscard]] Trajectory<S>& trajectory() noexcept {
        return plain_ ? *plain_ : smooth_ ? static_cast<Trajectory<S>&>(*smooth_) : *jerk_limited_;
    }
    /// Nothing where there is none: the plan is acceleration-limited, or averaged.
    [[nodiscard]] const JerkPlan<S>* jerk_plan() const noexcept {
        return jerk_limited_ ? &jerk_limited_->jerk_plan() : nullptr;
    }
    /// Memory that it plans in.
    [[nodiscard]] std::size_t bytes() const noexcept {
        return sizeof(ArcLength<S>) + sizeof(FeedPlan<S>) + window_.size() * sizeof(PlannedCell<S>) +
               (smooth_ ? sizeof(SmoothPlan<S>) + sizeof(SmoothSampler<S>) : 0) +
               smooth_cells_.size() * sizeof(SmoothCell<S>) + places_.size() * sizeof(PathPosition) +
               (jerk_limited_ ? sizeof(JerkPlan<S>) : 0) + cells_.size() * sizeof(Cell<S>) +
               nodes_.size() * sizeof(JerkNode);
    }

private:
    /// Where motions are averaged it is their window that looks far ahead.
    [[nodiscard]] static std::size_t feed_cells(const MotionLimits<S>& limits, std::size_t window_cells) {
        const bool averaged = limits.jerk_limited && limits.jerk_tier == JerkTier::bounded;
        return averaged ? std::max(window_cells / 2, FeedPlan<S>::smallest_window) : window_cells;
    }

    std::vector<PlannedCell<S>> window_;
    std::vector<Cell<S>> cells_;
    std::vector<JerkNode> nodes_;
    std::vector<SmoothCell<S>> smooth_cells_;
    std::vector<PathPosition> places_;
    std::unique_ptr<Trajectory<S>> plain_;
    std::unique_ptr<SmoothTrajectory<S>> smooth_;
    std::unique_ptr<JerkTrajectory<S>> jerk_limited_;
};

} // namespace splinefeed::host
