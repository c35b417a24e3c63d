// SPDX-License-Identifier: MIT
// MachineDescription: a machine file in memory.
#pragma once

#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"
#include "splinefeed/s5_pulse_train/step_timing.hpp"

#include <array>
#include <optional>
#include <string>

namespace splinefeed::host {

/// Soft limits of an axis [mm].
struct Travel {
    double low = 0.0;
    double high = 0.0;
};

/// The motors on an axis's step and direction lines.
struct StepMotors {
    int count = 1;                          ///< 1 or 2
    bool invert_step = false;               ///< the line is low in a pulse
    std::array<bool, 2> invert_direction{}; ///< of each motor: the line is low where the axis goes up
};

struct MachineDescription {
    std::string file; ///< where it was read, for messages; empty: the built-in default machine
    std::string name = "default machine";
    MachineSettings settings{}; ///< numbers, in the core's form
    /// Whether drives stay enabled where a run is over and they stand; nothing: Modbus drives do, those on lines do
    /// not.
    std::optional<bool> drives_on_at_end{};
    PerAxis<std::string> axis_name{};        ///< "x", "y", ...
    PerAxis<std::optional<Travel>> travel{}; ///< soft limits where the file states them
    StepSettings step{};                     ///< of the step and direction lines of all axes
    PerAxis<StepMotors> motors{};            ///< `invert` is in their directions already
    PerAxis<bool> inverted{};                ///< its drive counts down where the axis goes up
    PerAxis<std::string> drive{};            ///< address of the axis's drive, for --target modbus; empty: none
};

} // namespace splinefeed::host
