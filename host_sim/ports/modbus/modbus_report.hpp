// SPDX-License-Identifier: MIT
// modbus_report: which drives answer at an address, how fast and how reliably, and what to do.
#pragma once

#include "host_sim/config/machine_description.hpp"
#include "host_sim/ports/link_report.hpp"

#include <string>

namespace splinefeed::host {

/// Measures every drive of a target for the given time; nothing moves. Returns the state of each drive, the
/// measurements and advice; the trouble is a drive in fault. Throws UsageError, InputError, and TargetError if a drive
/// cannot be used.
/// @param target  "modbus", or the address of a drive
/// @param any_axes  the user named no machine: the machine of an address has as many axes as the drive
[[nodiscard]] LinkReport modbus_report(const std::string& target, MachineDescription machine, bool any_axes,
                                       double seconds);

} // namespace splinefeed::host
