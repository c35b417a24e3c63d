// SPDX-License-Identifier: MIT
// program_lines_section: the tables [lines], [coolant] and [[output]] of a machine file.
#pragma once

#include "host_sim/base/toml_checker.hpp"
#include "host_sim/config/program_lines.hpp"

namespace splinefeed::host {

/// Empty if the file has none of them. Throws InputError.
[[nodiscard]] ProgramLines read_program_lines(const TomlChecker& check, const toml::table& root);

} // namespace splinefeed::host
