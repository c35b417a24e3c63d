// SPDX-License-Identifier: MIT
#include "host_sim/targets/spindle_table.hpp"

#include "host_sim/target/modbus/vfd_run_spindle.hpp"

namespace splinefeed::host {

std::unique_ptr<RunSpindle> make_spindle(const MachineDescription& machine, const std::string& target) {
    return machine.spindle && machine.spindle->vfd ? make_vfd_spindle(machine, target) : nullptr;
}

} // namespace splinefeed::host
