// SPDX-License-Identifier: MIT
// limit_trial: a program in G-code that tries accelerations of one axis, to find what the machine can do.
#pragma once

#include "host_sim/config/machine_description.hpp"

#include <string>
#include <string_view>

namespace splinefeed::host {

/// Who runs the program: "grbl", "linuxcnc", "klipper" or "marlin".
[[nodiscard]] std::string trial_controllers();

/// Rounds of long strokes, which reach the velocity where the travel is long enough, and of short ones, which turn as
/// often as they can. Each ends at one place, slowly: who has lost steps stands beside it. Klipper and Marlin get their
/// acceleration in the program, round by round; for the others it is one round, and its first lines say what to set.
/// Throws UsageError where there is no such axis or controller, or the axis has no travel.
[[nodiscard]] std::string limit_trial(const MachineDescription& machine, const std::string& axis,
                                      const std::string& controller);

} // namespace splinefeed::host
