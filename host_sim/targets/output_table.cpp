// SPDX-License-Identifier: MIT
#include "host_sim/targets/output_table.hpp"

#include "host_sim/target/gpio/gpio_switches.hpp"
#include "host_sim/target/modbus/vfd_run_spindle.hpp"

namespace splinefeed::host {

std::unique_ptr<ProgramOutputs> make_outputs(const MachineDescription& machine, const std::string& target) {
    std::unique_ptr<RunSwitches> switches = make_gpio_switches(machine);
    std::unique_ptr<RunSpindle> spindle;
    if (machine.spindle && machine.spindle->vfd) {
        spindle = make_vfd_spindle(machine, target);
    }
    return std::make_unique<ProgramOutputs>(std::move(spindle), std::move(switches));
}

} // namespace splinefeed::host
