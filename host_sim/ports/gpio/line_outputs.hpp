// SPDX-License-Identifier: MIT
// LineOutputs: what a program switches and reads by GPIO lines in a run.
#pragma once

#include "host_sim/config/machine_description.hpp"
#include "host_sim/ports/run_inputs.hpp"
#include "host_sim/ports/run_spindle.hpp"
#include "host_sim/ports/run_switches.hpp"

#include <memory>

namespace splinefeed::host {

/// Null: the machine has none on lines.
struct LineOutputs {
    std::unique_ptr<RunSpindle> spindle;
    std::unique_ptr<RunSwitches> switches;
    std::unique_ptr<RunInputs> inputs;
};

/// Requests the lines: all are as they are safe. Throws TargetError. `machine` must outlive them.
[[nodiscard]] LineOutputs make_line_outputs(const MachineDescription& machine);

} // namespace splinefeed::host
