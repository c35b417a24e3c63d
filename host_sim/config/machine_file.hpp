// SPDX-License-Identifier: MIT
// machine_file: reads a Machine .toml.
#pragma once

#include "host_sim/config/machine_description.hpp"

#include <string>
#include <string_view>

namespace splinefeed::host {

/// Reads and checks the file, every key of it. Throws InputError, with the line of what is wrong.
[[nodiscard]] MachineDescription read_machine_file(const std::string& path);

/// The same for a text; `file` is its name in messages.
[[nodiscard]] MachineDescription parse_machine(std::string_view text, const std::string& file);

/// The machine without a file: three axes, 100 mm/s, 1000 mm/s^2, feed 100 mm/s, 1 ms, 320 steps/mm, any travel.
[[nodiscard]] MachineDescription default_machine();

} // namespace splinefeed::host
