// SPDX-License-Identifier: MIT
// ProgramComment: a comment in ( ), and what it asks for.
#pragma once

#include "splinefeed/s0_program/text/program_errors.hpp"
#include "splinefeed/s0_program/text/text_cursor.hpp"

namespace splinefeed {

/// What a comment asks for. Others are text: LOG, LOGOPEN, LOGAPPEND, LOGCLOSE, PROBEOPEN and PROBECLOSE, which write
/// files in LinuxCNC, too.
enum class CommentKind : std::uint8_t { none, message, print, debug };

struct ProgramComment {
    CommentKind kind = CommentKind::none;
    TextPart text{}; ///< behind its comma
};

/// Goes over a comment. @param text  at its '('
/// @param open  it may hold a '(' and lack its ')'
/// Errors: comment_nested, comment_not_closed; program_aborted, with the cursor at the text of (ABORT, text).
ProgramStatus read_comment(TextCursor& text, bool open, ProgramComment& out) noexcept;

} // namespace splinefeed
