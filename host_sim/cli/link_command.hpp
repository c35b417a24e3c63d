// SPDX-License-Identifier: MIT
// link_command: `splinefeed link`, its options as they were typed and what it does: the report of a target.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace splinefeed::host {

struct LinkArguments {
    std::string target;  ///< empty: not given
    std::string machine; ///< empty: the default machine
    std::string seconds = "3";
};

void add_link_options(CLI::App& app, LinkArguments& arguments);

/// Measures for so long on every drive of the target, nothing moves, and prints what it found with advice.
/// Returns the exit status, 0. Throws UsageError, InputError, and TargetError where a drive cannot be used.
[[nodiscard]] int report_link(const LinkArguments& arguments);

} // namespace splinefeed::host
