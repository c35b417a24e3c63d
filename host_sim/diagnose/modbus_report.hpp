// SPDX-License-Identifier: MIT
// modbus_report: who answers at an address, how fast and how surely, and what to do about it.
#pragma once

#include "host_sim/config/machine_description.hpp"

#include <string>

namespace splinefeed::host {

/// Measures for so long on every drive of a target; nothing moves. What it found, with advice. Throws UsageError,
/// InputError, and TargetError where a drive cannot be used.
/// @param target  "modbus", or the address of a drive
/// @param any_axes  the user named no machine: that of an address has as many axes as the drive
[[nodiscard]] std::string modbus_report(const std::string& target, MachineDescription machine, bool any_axes,
                                        double seconds);

} // namespace splinefeed::host
