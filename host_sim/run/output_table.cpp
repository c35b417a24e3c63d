// SPDX-License-Identifier: MIT
#include "host_sim/run/output_table.hpp"

#include "host_sim/ports/gpio/line_outputs.hpp"
#include "host_sim/ports/modbus/modbus_outputs.hpp"

namespace splinefeed::host {

std::unique_ptr<ProgramOutputs> make_outputs(const MachineDescription& machine, const std::string& target) {
    std::unique_ptr<RunSpindle> spindle;
    ProgramOutputs::Switches switches;
    ProgramOutputs::Inputs inputs;
    OutputParts parts[] = {make_line_outputs(machine), make_modbus_outputs(machine, target)};
    for (OutputParts& some : parts) {
        if (some.spindle != nullptr) {
            spindle = std::move(some.spindle);
        }
        if (some.switches != nullptr) {
            switches.push_back(std::move(some.switches));
        }
        if (some.inputs != nullptr) {
            inputs.push_back(std::move(some.inputs));
        }
    }
    return std::make_unique<ProgramOutputs>(std::move(spindle), std::move(switches), std::move(inputs));
}

} // namespace splinefeed::host
