// SPDX-License-Identifier: MIT
// command_line: turns the command line into a job, or into a text that the user requested.
#pragma once

#include "host_sim/cli/job.hpp"

#include <string>
#include <variant>

namespace splinefeed::host {

/// A text for standard output: --help or --version.
struct Answer {
    std::string text;
};

/// Reads and checks the command line. Throws UsageError.
[[nodiscard]] std::variant<Job, Answer> parse_command_line(int argc, const char* const* argv);

} // namespace splinefeed::host
