// SPDX-License-Identifier: MIT
// ServedMotion: the motion of a controller for a machine, with its planner and its memory.
#pragma once

#include "host_sim/planning/machine_limits.hpp"
#include "host_sim/planning/planner_memory.hpp"
#include "host_sim/program/gcode/parameter_memory.hpp"

#include "splinefeed/controller/line_motion.hpp"
#include "splinefeed/controller/travel_guard.hpp"
#include "splinefeed/move_stream/scalar_stream.hpp"
#include "splinefeed/s0_program/cycles/spline_points.hpp"
#include "splinefeed/s0_program/expression.hpp"

namespace splinefeed::host {

class ServedMotion {
public:
    /// Throws InputError where the machine's limits do not go together. `settings` must outlive it.
    ServedMotion(const MachineDescription& machine, const ControllerSettings& settings)
        : limits_(machine_limits<Fixed>(machine, PlannerChoice{}.sampled())), planner_(limits_, {}),
          guard_(settings.travel, limits_.axes),
          stream_(limits_, planner_.planner(), rules_cast<Fixed>(machine.tolerances.rules), &guard_),
          motion_(settings, stream_, &points_, &expression_) {}
    ServedMotion(const ServedMotion&) = delete;
    ServedMotion& operator=(const ServedMotion&) = delete;

    [[nodiscard]] LineMotion& motion() noexcept { return motion_; }

private:
    MotionLimits<Fixed> limits_;
    PlannerMemory<Fixed> planner_;
    TravelGuard<Fixed> guard_;
    ScalarStream<Fixed> stream_;
    SplinePoints<ProgramScalar> points_;
    ParameterMemory parameters_;
    Expression expression_{parameters_};
    LineMotion motion_;
};

} // namespace splinefeed::host
