// SPDX-License-Identifier: MIT
#include "host_sim/targets/output_table.hpp"

#include "host_sim/target/gpio/line_outputs.hpp"
#include "host_sim/target/modbus/vfd_run_spindle.hpp"

namespace splinefeed::host {

std::unique_ptr<ProgramOutputs> make_outputs(const MachineDescription& machine, const std::string& target) {
    LineOutputs lines = make_line_outputs(machine);
    if (machine.spindle && machine.spindle->vfd) {
        lines.spindle = make_vfd_spindle(machine, target);
    }
    return std::make_unique<ProgramOutputs>(std::move(lines.spindle), std::move(lines.switches));
}

} // namespace splinefeed::host
