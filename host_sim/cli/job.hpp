// SPDX-License-Identifier: MIT
// Job: what one call of the tool is to do.
#pragma once

#include "host_sim/cli/link_command.hpp"
#include "host_sim/drive/drive_command.hpp"
#include "host_sim/run/runner.hpp"
#include "host_sim/surface/surface_arguments.hpp"

namespace splinefeed::host {

enum class Command { run, plan, curve, surface, drive, link };

struct Job {
    Command command = Command::run;
    RunArguments run; ///< run, plan and curve; of surface the input and the scalar
    SurfaceArguments surface;
    DriveArguments drive;
    LinkArguments link;
};

/// Returns the exit status: 0 done, 1 the machine did not finish (told on standard error). Throws InputError,
/// UsageError and OutputError where there is nothing to be done (exit status 2); then no output is left behind.
[[nodiscard]] int carry_out(const Job& job);

} // namespace splinefeed::host
