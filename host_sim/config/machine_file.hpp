// SPDX-License-Identifier: MIT
// machine_file: reads a Machine .toml.
#pragma once

#include "host_sim/config/machine_description.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace splinefeed::host {

/// [bytes]
inline constexpr std::size_t largest_machine_file = std::size_t{1} << 20U;

/// Reads the file and checks every key. Throws InputError, with the line of the error.
/// @param settings  as apply_setting() takes them: they replace what the file states, and the machine's name says so.
///                  Throws UsageError for them.
[[nodiscard]] MachineDescription read_machine_file(const std::string& path,
                                                   const std::vector<std::string>& settings = {});

/// The same for a text; `file` is its name in messages.
[[nodiscard]] MachineDescription parse_machine(std::string_view text, const std::string& file,
                                               const std::vector<std::string>& settings = {});

/// All that is wrong with a text, a sentence each, as parse_machine() says it of the first one. Of [spindle], [lines]
/// and what goes with them only the first.
[[nodiscard]] std::vector<std::string> machine_problems(std::string_view text, const std::string& file);

/// The machine that is used without a file: three axes, 100 mm/s, 1000 mm/s^2, feed 100 mm/s, 1 ms, 320 steps/mm, no
/// soft limits.
[[nodiscard]] MachineDescription default_machine(const std::vector<std::string>& settings = {});

} // namespace splinefeed::host
