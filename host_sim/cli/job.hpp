// SPDX-License-Identifier: MIT
// Job: the work of one call of the tool.
#pragma once

#include "host_sim/cli/link_command.hpp"
#include "host_sim/cli/machine_command.hpp"
#include "host_sim/drive/drive_command.hpp"
#include "host_sim/run/runner.hpp"
#include "host_sim/serve/serve_command.hpp"
#include "host_sim/surface/surface_arguments.hpp"

namespace splinefeed::host {

enum class Command { run, plan, check, curve, surface, drive, link, machine, serve };

struct Job {
    Command command = Command::run;
    RunArguments run; ///< for run, plan and curve; for surface only the input and the scalar
    SurfaceArguments surface;
    DriveArguments drive;
    LinkArguments link;
    MachineArguments machine;
    ServeArguments serve;
};

/// Returns the exit status: 0 done, 1 the machine did not finish (reported on standard error). Throws InputError,
/// UsageError and OutputError if the job cannot be done (exit status 2); then no output is left.
[[nodiscard]] int carry_out(const Job& job);

} // namespace splinefeed::host
