// SPDX-License-Identifier: MIT
// link_command: the command `splinefeed link`: its options as typed, and its report about a target.
#pragma once

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

} // namespace splinefeed::host
