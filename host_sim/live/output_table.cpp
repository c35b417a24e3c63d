// SPDX-License-Identifier: MIT
#include "host_sim/live/output_table.hpp"

#include "host_sim/ports/gpio/line_outputs.hpp"
#include "host_sim/ports/modbus/modbus_outputs.hpp"
#include "host_sim/ports/sim/sim_target.hpp"
#include "host_sim/ports/target_table.hpp"

namespace splinefeed::host {

std::unique_ptr<ProgramOutputs> make_outputs(const MachineDescription& machine, const std::string& target) {
    if (!target_kind(target).is_real) {
        return std::make_unique<ProgramOutputs>(
            machine.spindle ? std::make_unique<SimSpindle>(*machine.spindle) : nullptr, ProgramOutputs::Switches{});
    }
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
