// SPDX-License-Identifier: MIT
// make_vfd_spindle: a spindle behind a frequency inverter on Modbus, for a run.
#pragma once

#include "host_sim/config/machine_description.hpp"
#include "host_sim/ports/run_spindle.hpp"

#include <memory>
#include <string>

namespace splinefeed::host {

/// Connects to the inverter, and stops it. Throws TargetError if it cannot be used, and UsageError if a drive of the
/// run is on its wire. @param target  of the run. @pre machine.spindle has a vfd; the machine outlives the spindle
[[nodiscard]] std::unique_ptr<RunSpindle> make_vfd_spindle(const MachineDescription& machine,
                                                           const std::string& target);

} // namespace splinefeed::host
