// SPDX-License-Identifier: MIT
// FlowWord: the O word of a line: sub, call, if, while, ...; M words that belong to subprograms.
#pragma once

#include "splinefeed/s0_program/text/text_cursor.hpp"

#include <optional>
#include <string>

namespace splinefeed::host {

enum class FlowKind : std::uint8_t {
    sub,
    endsub,
    call,
    return_,
    if_,
    elseif,
    else_,
    endif,
    while_,
    endwhile,
    do_,
    repeat,
    endrepeat,
    break_,
    continue_,
    program,       ///< O1000 alone: a numbered program begins
    call_program,  ///< M98
    call_lines,    ///< M97: lines from an N number on
    end_program,   ///< M99
    save_modes,    ///< M70
    forget_modes,  ///< M71
    restore_modes, ///< M72
    lend_modes,    ///< M73: they are put back where the subprogram ends
};

struct FlowWord {
    FlowKind kind = FlowKind::sub;
    std::string label;       ///< "100", or a name in lower case without spaces; empty: it is an expression
    std::size_t label_at;    ///< offset of the label in the line
    std::size_t rest;        ///< offset of what stands behind the keyword; of M98: of the number behind L; 0: none
    bool has_number = false; ///< of M98 and M99: P
    std::string others{};    ///< what else the line of an M word says, each word at its place; empty: nothing
};

/// Whether a line begins with an O word, behind an N number at most.
[[nodiscard]] bool has_flow_word(std::string_view text) noexcept;

/// Whether it is a number without a keyword, as controls name programs: O1000 (PART).
[[nodiscard]] bool is_program_number(std::string_view text) noexcept;

/// Over a number, an expression in brackets, or a parameter.
void skip_value(TextCursor& text) noexcept;

/// The label of a numbered program: no label of an O word is equal.
[[nodiscard]] std::string program_label(std::string_view number);

/// The label of the lines that M97 calls.
[[nodiscard]] std::string lines_label(std::string_view number);

/// The N number that a line begins with, without zeros in front. Empty: none.
[[nodiscard]] std::string line_number_of(std::string_view text);

/// The word. Nothing: it has no label or no known keyword; `wrong` is where.
[[nodiscard]] std::optional<FlowWord> read_flow_word(std::string_view text, std::size_t& wrong);

} // namespace splinefeed::host
