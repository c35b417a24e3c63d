// SPDX-License-Identifier: MIT
// gpio_link: measures what this host can do with the lines of a machine; nothing moves.
#pragma once

#include "host_sim/config/gpio_address.hpp"
#include "host_sim/config/machine_description.hpp"

#include <string>

namespace splinefeed::host {

/// Requests the lines, with the drives off, measures for the given time, and reports what that means for the machine.
/// Throws InputError and TargetError.
[[nodiscard]] std::string gpio_report(const GpioAddress& address, const MachineDescription& machine, double seconds);

} // namespace splinefeed::host
