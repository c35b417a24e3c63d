// SPDX-License-Identifier: MIT
// Console: what an operator types at the terminal of the server, in words.
#pragma once

#include <string>
#include <string_view>

namespace splinefeed::host {

/// What a typed line asks for.
struct ConsoleOrder {
    std::string bytes{}; ///< for the controller
    std::string text{};  ///< for the operator, at once
    bool stops = false;  ///< anybody may send the bytes, also while a sender has the machine
    bool leaves = false; ///< the server ends
};

/// "jog x 10", "hold", "help", ...; everything else is a line of G-code or a `$` line.
[[nodiscard]] ConsoleOrder console_order(std::string_view line);

} // namespace splinefeed::host
