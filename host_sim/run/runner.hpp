// SPDX-License-Identifier: MIT
// runner: carries out a job: input -> curve -> trajectory -> machine, with the outputs on the way.
#pragma once

#include "host_sim/cli/job.hpp"

namespace splinefeed::host {

/// Returns the exit status: 0 done, 1 the machine did not finish (told on standard error). Throws InputError,
/// UsageError and OutputError where there is nothing to be done (exit status 2); then no output is left behind.
///
/// A file is checked whole, limits included, before anything moves. A pipe moves the machine while it is read, in
/// constant memory: what is wrong in it after the first move ends the run in a controlled stop.
[[nodiscard]] int run(const Job& job);

} // namespace splinefeed::host
