// SPDX-License-Identifier: MIT
// command_line: what the user typed becomes a job, or the text that was asked for.
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
