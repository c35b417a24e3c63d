// SPDX-License-Identifier: MIT
// gpio_map: reads a map file, which states the use of the lines of GPIO chips (docs/reference/gpio.md).
#pragma once

#include "host_sim/config/machine_description.hpp"

#include "splinefeed/hal/gpio/pin_map.hpp"

#include <string>
#include <string_view>

namespace splinefeed::host {

/// Reads the file and checks every key against the machine's axes, motors and polarities.
/// @param chip  chip of lines for which the file names none
/// Throws InputError, with the line of the error. Whether a chip has these lines is only known when they are requested.
[[nodiscard]] hal::gpio::PinMap read_gpio_map(const std::string& file, const MachineDescription& machine,
                                              const std::string& chip);

/// The same for a text; `file` is its name in messages.
[[nodiscard]] hal::gpio::PinMap parse_gpio_map(std::string_view text, const std::string& file,
                                               const MachineDescription& machine, const std::string& chip);

} // namespace splinefeed::host
