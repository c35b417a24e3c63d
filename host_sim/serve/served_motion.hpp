// SPDX-License-Identifier: MIT
// ServedMotion: the motion of a controller for a machine, with its planner and its memory.
#pragma once

#include "host_sim/planning/machine_limits.hpp"
#include "host_sim/planning/planned_trajectory.hpp"

#include "splinefeed/controller/scalar_motion.hpp"
#include "splinefeed/s0_program/spline_points.hpp"

#include <optional>
#include <vector>

namespace splinefeed::host {

class ServedMotion {
public:
    /// Throws InputError where the machine's limits do not go together. `settings` must outlive it.
    ServedMotion(const MachineDescription& machine, const ControllerSettings& settings)
        : limits_(machine_limits<Fixed>(machine)), window_(PlannerChoice{}.window_cells),
          motion_(settings, limits_, planner(), rules_cast<Fixed>(machine.tolerances.rules), &points_) {}
    ServedMotion(const ServedMotion&) = delete;
    ServedMotion& operator=(const ServedMotion&) = delete;

    [[nodiscard]] LineMotion& motion() noexcept { return motion_; }

private:
    [[nodiscard]] Planner<Fixed>& planner() {
        if (!limits_.jerk_limited) {
            return acceleration_.emplace(window_);
        }
        return jerk_.emplace(window_).planner;
    }

    MotionLimits<Fixed> limits_;
    std::vector<PlannedCell<Fixed>> window_;
    std::optional<AccelerationPlanner<Fixed>> acceleration_; // one of the two
    std::optional<hal::JerkMemory<Fixed, double>> jerk_;
    SplinePoints<Fixed> points_;
    ScalarMotion<Fixed> motion_;
};

} // namespace splinefeed::host
