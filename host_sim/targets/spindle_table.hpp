// SPDX-License-Identifier: MIT
// spindle_table: the spindle of a run, of the kind that the machine file names.
#pragma once

#include "host_sim/config/machine_description.hpp"
#include "host_sim/target/run_spindle.hpp"

#include <memory>
#include <string>

namespace splinefeed::host {

/// Null: the machine has no spindle that can be controlled. Throws like make_vfd_spindle().
[[nodiscard]] std::unique_ptr<RunSpindle> make_spindle(const MachineDescription& machine, const std::string& target);

} // namespace splinefeed::host
