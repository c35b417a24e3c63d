// SPDX-License-Identifier: MIT
// macro_word: statements of Fanuc's custom macro B that lead elsewhere: IF, GOTO, WHILE, DO, END, G65, alarms.
#pragma once

#include "host_sim/program/gcode/flow_word.hpp"

namespace splinefeed::host {

/// Whether a line begins with such a statement, behind / and an N number at most.
[[nodiscard]] bool has_macro_word(std::string_view line) noexcept;

/// The statement. Nothing: it is none that there is; `wrong` is where, and `right` what would be right there.
[[nodiscard]] std::optional<FlowWord> read_macro_word(std::string_view line, std::size_t& wrong,
                                                      std::string_view& right);

/// The number N of a line, behind / at most. Nothing: it has none, or not a whole one below 1e9.
[[nodiscard]] std::optional<std::uint32_t> line_label(std::string_view line) noexcept;

/// The variable of an argument of G65: 1 for A. 0: the letter is none.
[[nodiscard]] std::int32_t argument_number(char letter) noexcept;

/// What stands in the first comment of a line.
[[nodiscard]] std::string_view comment_of(std::string_view line) noexcept;

} // namespace splinefeed::host
