// SPDX-License-Identifier: MIT
#include "host_sim/live/output_table.hpp"

#include "host_sim/ports/gpio/pin_outputs.hpp"
#include "host_sim/ports/modbus/modbus_outputs.hpp"
#include "host_sim/ports/sim/sim_target.hpp"
#include "host_sim/ports/target_table.hpp"

#include <algorithm>
#include <iterator>

namespace splinefeed::host {

std::unique_ptr<ProgramOutputs> make_outputs(const MachineDescription& machine, const std::string& target) {
    OutputParts parts;
    if (!target_kind(target).is_real) {
        if (machine.spindle) {
            parts.push_back(std::make_shared<SimSpindle>(*machine.spindle));
        }
    } else {
        parts = make_pin_outputs(machine);
        std::ranges::move(make_modbus_outputs(machine, target), std::back_inserter(parts));
    }
    return std::make_unique<ProgramOutputs>(std::move(parts));
}

} // namespace splinefeed::host
