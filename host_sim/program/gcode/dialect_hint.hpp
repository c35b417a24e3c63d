// SPDX-License-Identifier: MIT
// dialect_hint, option_advice: what a line means that is not as the dialect has it, and the option that helps.
#pragma once

#include "host_sim/program/gcode_settings.hpp"

#include "splinefeed/s0_program/text/program_errors.hpp"

#include <string>
#include <string_view>

namespace splinefeed::host {

/// What would be right where a line was refused because it is another control's, has a decimal comma, or is no G-code.
/// Empty: describe(error) says it.
/// @param text  of the line, from what is wrong on
[[nodiscard]] std::string_view dialect_hint(std::string_view text, ProgramError error, Dialect dialect);

/// What stands behind the core's sentence, from its semicolon on. Empty: no option helps.
[[nodiscard]] std::string_view option_advice(ProgramError error);

/// What is said where a line was refused: its hint, or the core's sentence with its advice. Where --ignore names a word
/// that is never left out, the sentence says why.
/// @param text  of the line, from what is wrong on
[[nodiscard]] std::string refusal_sentence(std::string_view text, ProgramError error, const GcodeSettings& settings);

} // namespace splinefeed::host
