// SPDX-License-Identifier: MIT
// check_program: a program in G-code without a machine: everything that is wrong with it, what it does, and how long it
// takes.
#pragma once

#include "host_sim/run/runner.hpp"

namespace splinefeed::host {

/// Prints the report on standard output: as text, or as JSON if the summary is asked for as that. Returns 0, or 1 if
/// the program has problems. Throws like run().
[[nodiscard]] int check_program(const RunArguments& arguments);

} // namespace splinefeed::host
