// SPDX-License-Identifier: MIT
// GrblMachine: the machine file that says what a controller of the grbl family answers to $$.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace splinefeed::host {

struct GrblMachine {
    std::string text;         ///< a machine file; what it cannot say is a comment at its end
    std::size_t left_out = 0; ///< how many numbers are in that comment
};

/// Of lines like `$110=8000.000`, with whatever a terminal writes before them, and a description behind. Other lines
/// are left out. Throws InputError where a number is missing that a machine file needs, where one has two values, and
/// where one is no number or out of range.
/// @param file  of the listing, for messages
[[nodiscard]] GrblMachine machine_of_grbl(std::string_view listing, const std::string& file);

} // namespace splinefeed::host
