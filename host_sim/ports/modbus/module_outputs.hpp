// SPDX-License-Identifier: MIT
// ModuleOutputs: what a program switches and reads by Modbus I/O modules in a run.
#pragma once

#include "host_sim/config/machine_description.hpp"
#include "host_sim/ports/run_inputs.hpp"
#include "host_sim/ports/run_switches.hpp"

#include <memory>
#include <string>

namespace splinefeed::host {

/// Null: the machine has no modules.
struct ModuleOutputs {
    std::unique_ptr<RunSwitches> switches;
    std::unique_ptr<RunInputs> inputs;
};

/// Connects to the modules: every coil and input that the machine file names is tried out, and all outputs are as they
/// are safe. Throws TargetError if one cannot be used, and UsageError if a drive of the run or its spindle is on the
/// wire of a module. @param target  of the run. `machine` must outlive them.
[[nodiscard]] ModuleOutputs make_module_outputs(const MachineDescription& machine, const std::string& target);

} // namespace splinefeed::host
