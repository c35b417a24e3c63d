// SPDX-License-Identifier: MIT
// step_lines: whether a machine's step and direction lines carry what its limits allow.
#pragma once

#include "host_sim/config/machine_description.hpp"

namespace splinefeed::host {

/// The times of the lines. Throws InputError, one sentence with the axis and the rate, where a plan within the
/// machine's limits could ask for more: nothing is shifted later.
[[nodiscard]] StepTiming checked_step_timing(const MachineDescription& machine);

} // namespace splinefeed::host
