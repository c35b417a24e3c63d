// SPDX-License-Identifier: MIT
// ServeArguments: the options of `splinefeed serve` as typed, and the command.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace splinefeed::host {

/// No value: not given.
struct ServeArguments {
    std::string machine;                 ///< empty: not named; MachineChoice
    std::vector<std::string> settings{}; ///< of --set
    std::string target = "sim";
    std::optional<std::string> tcp;
    std::optional<std::string> pty;
    std::optional<std::string> state;
};

/// Serves senders until it is interrupted; then the machine stands. Returns the exit status. Throws UsageError,
/// InputError, OutputError.
[[nodiscard]] int run_serve(const ServeArguments& arguments);

} // namespace splinefeed::host
