// SPDX-License-Identifier: MIT
// FlowWord: the O word of a line: sub, call, if, while, ...
#pragma once

#include "splinefeed/s0_program/text_cursor.hpp"

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
};

struct FlowWord {
    FlowKind kind = FlowKind::sub;
    std::string label;    ///< "100", or a name in lower case without spaces; empty: it is an expression
    std::size_t label_at; ///< offset of the label in the line
    std::size_t rest;     ///< offset of what stands behind the keyword
};

/// Whether a line begins with an O word, behind an N number at most.
[[nodiscard]] bool has_flow_word(std::string_view text) noexcept;

/// Whether it is a number without a keyword, as controls name programs: O1000 (PART). @pre has_flow_word(text)
[[nodiscard]] bool is_program_number(std::string_view text) noexcept;

/// The word. Nothing: it has no label or no known keyword; `wrong` is where.
[[nodiscard]] std::optional<FlowWord> read_flow_word(std::string_view text, std::size_t& wrong);

} // namespace splinefeed::host
