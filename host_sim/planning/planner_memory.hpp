// SPDX-License-Identifier: MIT
// PlannerMemory: the planner that the limits of a machine need, with its memory.
#pragma once

#include "host_sim/planning/planned_path.hpp"

#include "splinefeed/acceleration_planner.hpp"
#include "splinefeed/hal/motion/jerk_memory.hpp"

#include <optional>
#include <vector>

namespace splinefeed::host {

template <Scalar S>
class PlannerMemory {
public:
    PlannerMemory(const MotionLimits<S>& limits, const PlannerChoice& choice) : window_(choice.window_cells) {
        if constexpr (!std::same_as<S, float>) { // which does not suffice for limits with jerk
            if (limits.jerk_limited && choice.jerk_scalar == ScalarKind::float32) {
                planner_ = &in_float_.emplace(window_).planner;
            } else if (limits.jerk_limited) {
                planner_ = &in_double_.emplace(window_).planner;
            }
        }
        if (planner_ == nullptr) {
            planner_ = &acceleration_.emplace(window_);
        }
    }
    PlannerMemory(const PlannerMemory&) = delete;
    PlannerMemory& operator=(const PlannerMemory&) = delete;

    [[nodiscard]] Planner<S>& planner() noexcept { return *planner_; }
    /// The number type of a JerkPlanner; empty: the jerk is not limited.
    [[nodiscard]] const char* jerk_scalar() const noexcept {
        return in_float_ ? scalar_name<float>() : in_double_ ? scalar_name<double>() : "";
    }
    /// Calls visit(JerkPlan) where the jerk is limited.
    template <class Visit>
    void visit_jerk(Visit&& visit) const {
        if (in_float_) {
            visit(in_float_->planner.plan());
        } else if (in_double_) {
            visit(in_double_->planner.plan());
        }
    }
    /// Memory of the planning, without that of the segment stream.
    [[nodiscard]] std::size_t bytes() const noexcept {
        return (acceleration_ ? sizeof *acceleration_
                : in_float_   ? in_float_->bytes()
                              : in_double_->bytes()) -
               sizeof(SegmentStream<S>) + window_.size() * sizeof(PlannedCell<S>);
    }

private:
    using JerkScalar = std::conditional_t<std::same_as<S, float>, double, S>;

    std::vector<PlannedCell<S>> window_;
    std::optional<AccelerationPlanner<S>> acceleration_; // one of the three
    std::optional<hal::JerkMemory<JerkScalar, double>> in_double_;
    std::optional<hal::JerkMemory<JerkScalar, float>> in_float_;
    Planner<S>* planner_ = nullptr;
};

} // namespace splinefeed::host
