// SPDX-License-Identifier: MIT
// line_checksum: what hosts of printers put behind a line, so that a wrong byte is noticed.
#pragma once

#include "splinefeed/s0_program/text/program_errors.hpp"
#include "splinefeed/s0_program/text/text_cursor.hpp"

namespace splinefeed {

/// Goes over "*71": the exclusive or of all characters before it. A ; comment may follow.
/// @param text  at the *
/// Errors: checksum_wrong, character_invalid.
ProgramStatus read_checksum(TextCursor& text) noexcept;

} // namespace splinefeed
