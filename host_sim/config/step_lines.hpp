// SPDX-License-Identifier: MIT
// step_lines: checks that step and direction lines can carry what the machine's limits allow.
#pragma once

#include "host_sim/config/machine_description.hpp"

namespace splinefeed::host {

/// The timing of the lines. Throws InputError, one sentence with the axis and the rate, if a plan within the machine's
/// limits could need more than the lines can carry: steps are never shifted later.
[[nodiscard]] StepTiming checked_step_timing(const MachineDescription& machine);

} // namespace splinefeed::host
