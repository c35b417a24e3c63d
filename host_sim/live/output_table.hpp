// SPDX-License-Identifier: MIT
// output_table: spindle, coolant, digital outputs and inputs of a run, of the kinds that the machine file names.
#pragma once

#include "host_sim/config/machine_description.hpp"
#include "host_sim/ports/program_outputs.hpp"

#include <memory>
#include <string>

namespace splinefeed::host {

/// Connects to them: the spindle stops, coolant is off, and outputs are safe. Throws TargetError if one cannot be used,
/// and UsageError if it does not go with the target. @param machine  must outlive them   @param target  of the run
[[nodiscard]] std::unique_ptr<ProgramOutputs> make_outputs(const MachineDescription& machine,
                                                           const std::string& target);

} // namespace splinefeed::host
