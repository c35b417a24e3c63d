// SPDX-License-Identifier: MIT
// machine_command: the command `splinefeed machine`: what is wrong with a machine file.
#pragma once

#include <string>

namespace splinefeed::host {

/// Prints all that is wrong with the file, a line each, or that nothing is. Returns the exit status: 0, or 1 if
/// something is wrong. Throws InputError where it cannot be read.
[[nodiscard]] int check_machine(const std::string& file);

} // namespace splinefeed::host
