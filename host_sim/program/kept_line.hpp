// SPDX-License-Identifier: MIT
// kept_line: lines that are no G-code and change what a program does, so that no option leaves them out.
#pragma once

#include "splinefeed/s0_program/dialects/code_table.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace splinefeed::host {

struct KeptLine {
    std::string_view word; ///< the first one, as it stands
    CodeEffect effect = CodeEffect::flow;
};

/// Whether the line begins with a word of a closed list: conditions and jumps of macros (IF, WHILE, GOTO), commands of
/// Klipper, Siemens and grbl that move the machine or its coordinates. An N number may stand before it.
[[nodiscard]] std::optional<KeptLine> kept_line(std::string_view line) noexcept;

/// "it changes the order of the blocks". @pre not CodeEffect::machine
[[nodiscard]] std::string_view effect_text(CodeEffect effect) noexcept;

/// What is said where such a line is refused.
[[nodiscard]] std::string refusal(const KeptLine& line);

} // namespace splinefeed::host
