// SPDX-License-Identifier: MIT
// MachineArguments: the options of `splinefeed machine`, and the command: what is wrong with a machine file, or one
// that is made of the numbers of a controller of the grbl family.
#pragma once

#include <string>

namespace splinefeed::host {

struct MachineArguments {
    bool from_grbl = false; ///< make a machine file of what a controller answers to $$
    std::string output;     ///< for it; empty: standard output
};

/// Prints all that is wrong with the file, a line each, or that nothing is; or makes one. Returns the exit status: 0,
/// or 1 if something is wrong. Throws InputError, UsageError, OutputError.
[[nodiscard]] int run_machine(const std::string& file, const MachineArguments& arguments);

} // namespace splinefeed::host
