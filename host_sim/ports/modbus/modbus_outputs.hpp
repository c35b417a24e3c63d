// SPDX-License-Identifier: MIT
// modbus_outputs: the spindle behind a frequency inverter on Modbus, and what a program switches and reads by Modbus
// I/O modules in a run.
#pragma once

#include "host_sim/config/machine_description.hpp"
#include "host_sim/ports/program_outputs.hpp"

namespace splinefeed::host {

/// Connects to the inverter, and stops it, and to the modules: every coil and input that the machine file names is
/// tried out, and all outputs are as they are safe. Throws TargetError if one cannot be used, and UsageError if a drive
/// of the run is on the wire of one, or the spindle on that of a module. @param target  of the run. `machine` must
/// outlive them.
[[nodiscard]] OutputParts make_modbus_outputs(const MachineDescription& machine, const std::string& target);

} // namespace splinefeed::host
