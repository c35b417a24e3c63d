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
    end_program,   ///< M99
    save_modes,    ///< M70
    forget_modes,  ///< M71
    restore_modes, ///< M72
    lend_modes,    ///< M73: they are put back where the subprogram ends
    // Of Fanuc's custom macro B.
    call_line,  ///< M97
    call_macro, ///< G65
    jump,       ///< GOTO
    jump_if,    ///< IF [...] GOTO
    then,       ///< IF [...] THEN
    loop,       ///< WHILE [...] DO1, DO1
    end_loop,   ///< END1
    alarm,      ///< #3000=1 (TEXT): it ends the program
    message,    ///< #3006=1 (TEXT): it stops it
};

struct FlowWord {
    FlowKind kind = FlowKind::sub;
    std::string label;       ///< "100", a name in lower case without spaces, or "DO1"; empty: it is an expression
    std::size_t label_at;    ///< offset of the label in the line
    std::size_t rest;        ///< offset of what stands behind the keyword; of M98: of the number behind L; 0: none
    bool has_number = false; ///< of M98 and M99: P
    std::string others{};    ///< what else the line of an M word says, each word at its place; empty: nothing
    std::size_t behind = 0;  ///< of IF: offset of what stands behind GOTO or THEN
};

/// Whether a line begins with an O word, behind an N number at most.
[[nodiscard]] bool has_flow_word(std::string_view text) noexcept;

/// Whether it is a number without a keyword, as controls name programs: O1000 (PART).
[[nodiscard]] bool is_program_number(std::string_view text) noexcept;

/// Over a number, an expression in brackets, or a parameter.
void skip_value(TextCursor& text) noexcept;

/// The label of a numbered program: no label of an O word is equal.
[[nodiscard]] std::string program_label(std::string_view number);
[[nodiscard]] constexpr bool is_program_label(std::string_view label) noexcept {
    return label.starts_with('O'); // the others are in lower case
}

/// The word. Nothing: it has no label or no known keyword; `wrong` is where.
[[nodiscard]] std::optional<FlowWord> read_flow_word(std::string_view text, std::size_t& wrong);

} // namespace splinefeed::host
