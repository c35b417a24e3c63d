// SPDX-License-Identifier: MIT
// gpio_link: what the lines of a machine can do on the host at hand, measured; nothing moves.
#pragma once

#include "host_sim/config/gpio_address.hpp"
#include "host_sim/config/machine_description.hpp"

#include <string>

namespace splinefeed::host {

/// Takes the lines, with the drives off, measures for so long, and says what that means for the machine.
/// Throws InputError and TargetError.
[[nodiscard]] std::string gpio_report(const GpioAddress& address, const MachineDescription& machine, double seconds);

} // namespace splinefeed::host
