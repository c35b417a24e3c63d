// SPDX-License-Identifier: MIT
// command_options: the options of run, plan, check and curve, with what --help says of them.
#pragma once

#include "host_sim/cli/job.hpp"

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace splinefeed::host {

/// What was typed, before it is checked.
struct Typed {
    std::optional<std::string> machine;
    std::optional<std::string> scalar;
    std::string format;
    std::string summary;
    std::optional<std::string> start;
    std::string window = "1024";
    std::string jerk_scalar = "double";
    bool json = false; ///< of check
};

void add_input(CLI::App& app, Job& job, Typed& typed);
void add_curve_options(CLI::App& app, Job& job, Typed& typed);
void add_gcode_options(CLI::App& app, Job& job);
/// @param executes  the command moves a machine
void add_machine_options(CLI::App& app, Job& job, Typed& typed, bool executes);

} // namespace splinefeed::host
