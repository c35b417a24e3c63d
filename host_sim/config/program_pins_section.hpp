// SPDX-License-Identifier: MIT
// program_pins_section: the tables [lines], [[module]], [coolant], [[output]] and [[input]] of a machine
// file, and the lines of [spindle].
#pragma once

#include "host_sim/base/toml_checker.hpp"
#include "host_sim/config/program_pins.hpp"
#include "host_sim/config/spindle_description.hpp"

#include <optional>

namespace splinefeed::host {

/// Empty if the file has none of them. Throws InputError. @param spindle  of the file; gets its lines
[[nodiscard]] ProgramPins read_program_pins(const TomlChecker& check, const toml::table& root,
                                            std::optional<SpindleDescription>& spindle);

} // namespace splinefeed::host
