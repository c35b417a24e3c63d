// SPDX-License-Identifier: MIT
// Job: the work of one call of the tool. The commands `splinefeed link` and `splinefeed machine`, with their options as
// typed.
#pragma once

#include "host_sim/drive/drive_command.hpp"
#include "host_sim/run/runner.hpp"
#include "host_sim/serve/serve_command.hpp"
#include "host_sim/surface/surface_arguments.hpp"

#include <string>
#include <vector>

namespace splinefeed::host {

struct LinkArguments {
    std::string target;                  ///< empty: not given
    std::string machine;                 ///< empty: not named; MachineChoice
    std::vector<std::string> settings{}; ///< of --set
    std::string seconds = "3";
};

/// Measures every drive of the target for the given time and prints the result with advice; nothing moves. Returns the
/// exit status, 0. Throws UsageError, InputError, and TargetError if a drive cannot be used or is in fault.
[[nodiscard]] int report_link(const LinkArguments& arguments);

struct MachineArguments {
    bool checks = false; ///< --check was typed
    std::string from;    ///< the kind of another controller's file; empty: as its text says
    std::string to;      ///< the other controller that gets the machine file's numbers; empty: none
    std::string output;  ///< what is made of it; empty: standard output
    std::string answers; ///< file with what it does not say; empty: none
    std::string tried;   ///< axis of which a program tries accelerations; empty: none
    std::string tried_by = "grbl";
};

/// Prints all that is wrong with the file, a line each, or that nothing is; or makes one. Returns the exit status: 0,
/// or 1 if something is wrong. Throws InputError, UsageError, OutputError.
[[nodiscard]] int run_machine(const std::string& file, const MachineArguments& arguments);

enum class Command { run, plan, check, curve, surface, drive, link, machine, schema, serve };

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
