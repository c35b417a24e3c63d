// SPDX-License-Identifier: MIT
#include "host_sim/config/step_lines.hpp"

#include "host_sim/base/input_error.hpp"

#include <algorithm>

namespace splinefeed::host {

namespace {

/// What the engines' integers hold (AxisCubic).
constexpr double most_steps_in_a_segment = 80000.0;

void check(const MachineDescription& machine, unsigned k, const StepTiming& timing) {
    const AxisSettings& axis = machine.settings.axis[k];
    const std::string& name = machine.axis_name[k];
    const double velocity =
        axis.rotary ? axis.max_velocity_mm_s : std::min(axis.max_velocity_mm_s, machine.settings.max_feed_mm_s);
    const StepDemand demand{velocity * axis.steps_per_mm, axis.larger_acceleration_mm_s2() * axis.steps_per_mm};
    const double turn_us = timing.turn_gap() / static_cast<double>(ticks_per_us);
    switch (timing.allows(demand).error()) {
    case Error::none: break;
    case Error::step_rate_too_high:
        throw InputError(machine.file, 0,
                         "axis {} makes {:.0f} steps/s at {} mm/s, and its lines carry {:.0f}; lower the "
                         "velocity or steps_per_mm, or shorten {} in [step]",
                         name, demand.steps_per_s, velocity, timing.most_steps_per_s(),
                         timing.grid > 1 || timing.tick > 1 ? "tick_us, step_length_us and step_space_us"
                                                            : "step_length_us and step_space_us");
    default:
        throw InputError(machine.file, 0,
                         "axis {} needs {:.3f} us from a step to one back, in which {:.0f} steps/s^2 go {:.4f} "
                         "steps to and fro, and {:.0f} steps; at most 1/64 and 24 are left to it; shorten "
                         "direction_setup_us and direction_hold_us in [step], or lower the acceleration",
                         name, turn_us, demand.steps_per_s2, timing.most_left_out(demand.steps_per_s2),
                         static_cast<double>(timing.turn_gap()) / timing.step_gap());
    }
    const double in_a_segment = demand.steps_per_s * machine.settings.sample_period_us * 1e-6;
    if (in_a_segment > most_steps_in_a_segment) {
        throw InputError(machine.file, 0,
                         "axis {} makes {:.0f} steps in a sample period; at most {:.0f} are possible; take a "
                         "shorter sample_period_us",
                         name, in_a_segment, most_steps_in_a_segment);
    }
}

} // namespace

StepTiming checked_step_timing(const MachineDescription& machine) {
    const Result<StepTiming> timing = StepTiming::make(machine.step);
    if (!timing.has_value()) {
        throw InputError(machine.file, 0, describe(timing.error()));
    }
    for (const unsigned k : indices(machine.settings.axes)) {
        check(machine, k, *timing);
    }
    return *timing;
}

} // namespace splinefeed::host
