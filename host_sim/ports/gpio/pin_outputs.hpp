// SPDX-License-Identifier: MIT
// pin_outputs: the spindle, the coolant, the outputs and the inputs of a machine on lines of GPIO chips.
#pragma once

#include "host_sim/config/machine_description.hpp"
#include "host_sim/ports/gpio/program_chips.hpp"
#include "host_sim/ports/output_parts.hpp"

#include "splinefeed/hal/rt/clock.hpp"

namespace splinefeed::host {

/// On the machine's lines, which are as they are safe. `machine` must outlive them.
[[nodiscard]] OutputParts pin_outputs(const MachineDescription& machine, const ProgramChips& chips,
                                      hal::Clock& clock = hal::system_clock());

/// Requests the lines. Throws TargetError. `machine` must outlive them.
[[nodiscard]] OutputParts make_pin_outputs(const MachineDescription& machine);

} // namespace splinefeed::host
