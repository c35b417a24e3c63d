// SPDX-License-Identifier: MIT
// MachineDescription: a machine file in memory.
#pragma once

#include "host_sim/config/path_tolerances.hpp"
#include "host_sim/config/program_pins.hpp"
#include "host_sim/config/spindle_description.hpp"

#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"
#include "splinefeed/s5_pulse_train/step_timing.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

namespace splinefeed::host {

/// Soft limits of an axis [mm].
struct Travel {
    double low = 0.0;
    double high = 0.0;
};

/// The motors on the step and direction lines of an axis.
struct StepMotors {
    int count = 1;                          ///< 1 or 2
    bool invert_step = false;               ///< the line is low during a pulse
    std::array<bool, 2> invert_direction{}; ///< for each motor: the line is low where the axis goes up
};

struct MachineDescription {
    std::string file; ///< path of the file, for messages; empty: the built-in default machine
    std::string name = "default machine";
    MachineSettings settings{}; ///< the numbers, in the form of the core
    PathTolerances tolerances{};
    /// Whether the drives stay enabled after a run, at standstill; nothing: drives on Modbus stay enabled, drives on
    /// GPIO lines do not.
    std::optional<bool> drives_on_at_end{};
    PerAxis<std::string> axis_name{};        ///< "x", "y", ...
    PerAxis<std::optional<Travel>> travel{}; ///< soft limits where the file states them
    std::optional<SpindleDescription> spindle{};
    ProgramPins lines{};
    StepSettings step{};          ///< of the step and direction lines of all axes
    PerAxis<StepMotors> motors{}; ///< their directions already include `invert`
    PerAxis<bool> inverted{};     ///< the drive counts down where the axis goes up
    /// How far apart the positions may lie that a shaft at standstill reports [mm]; nothing: the larger of 0.01 mm and
    /// 2 counts.
    PerAxis<std::optional<double>> standstill_window_mm{};
    PerAxis<std::string> drive{}; ///< address of the axis's drive, for --target modbus; empty: none
    /// Line of `file`, for messages: where the axis's drive is named, else where the axis begins.
    PerAxis<std::uint64_t> axis_line{};

    [[nodiscard]] bool has_drives() const noexcept {
        return std::ranges::any_of(drive, [](const std::string& address) { return !address.empty(); });
    }
};

/// The window of standstill of an axis, at least 1 count: a position on the edge of two is reported as either. [counts]
[[nodiscard]] double standstill_window_counts(const MachineDescription& machine, unsigned axis) noexcept;

} // namespace splinefeed::host
