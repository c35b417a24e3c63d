// SPDX-License-Identifier: MIT
// command_options: the commands and their options, with what --help says of them.
#pragma once

#include "host_sim/cli/job.hpp"

#include <optional>
#include <string>

namespace CLI {
class App;
}

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

/// For --help.
extern const char* const exit_statuses;

/// Adds all commands. What is typed goes to `job` and `typed`, which must outlive the app.
void describe_commands(CLI::App& app, Job& job, Typed& typed);

} // namespace splinefeed::host
