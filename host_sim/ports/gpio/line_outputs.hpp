// SPDX-License-Identifier: MIT
// LineOutputs: what a program switches and reads by GPIO lines in a run.
#pragma once

#include "host_sim/config/machine_description.hpp"
#include "host_sim/ports/program_outputs.hpp"

namespace splinefeed::host {

/// Requests the lines: all are as they are safe. Throws TargetError. `machine` must outlive them.
[[nodiscard]] OutputParts make_line_outputs(const MachineDescription& machine);

} // namespace splinefeed::host
