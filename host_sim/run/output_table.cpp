// SPDX-License-Identifier: MIT
#include "host_sim/run/output_table.hpp"

#include "host_sim/ports/gpio/line_outputs.hpp"
#include "host_sim/ports/modbus/module_outputs.hpp"
#include "host_sim/ports/modbus/vfd_run_spindle.hpp"

namespace splinefeed::host {

std::unique_ptr<ProgramOutputs> make_outputs(const MachineDescription& machine, const std::string& target) {
    LineOutputs lines = make_line_outputs(machine);
    if (machine.spindle && machine.spindle->vfd) {
        lines.spindle = make_vfd_spindle(machine, target);
    }
    ModuleOutputs modules = make_module_outputs(machine, target);
    ProgramOutputs::Switches switches;
    for (auto* const some : {&lines.switches, &modules.switches}) {
        if (*some != nullptr) {
            switches.push_back(std::move(*some));
        }
    }
    ProgramOutputs::Inputs inputs;
    for (auto* const some : {&lines.inputs, &modules.inputs}) {
        if (*some != nullptr) {
            inputs.push_back(std::move(*some));
        }
    }
    return std::make_unique<ProgramOutputs>(std::move(lines.spindle), std::move(switches), std::move(inputs));
}

} // namespace splinefeed::host
