// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/dialect_hint.hpp"

#include "splinefeed/s0_program/code_table.hpp"
#include "splinefeed/s0_program/decimal.hpp"
#include "splinefeed/s0_program/decimal_text.hpp"
#include "splinefeed/s0_program/text_cursor.hpp"

namespace splinefeed::host {

namespace {

bool is_printer_word(std::string_view text) {
    TextCursor cursor(text);
    Decimal number;
    if (!cursor.take('m') || !read_decimal(cursor, number).ok() || number.raw % Decimal::one != 0) {
        return false;
    }
    const CodeInfo info = find_m_code(static_cast<std::int32_t>(number.raw / Decimal::one), Dialect::marlin);
    return info.group == CodeGroup::printer && info.refusal == ProgramError::none;
}

/// Whether text begins like a call of a function: a name and a bracket.
bool is_call(std::string_view text) {
    const std::size_t end = text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ \t");
    return end != std::string_view::npos && text[end] == '[';
}

} // namespace

std::string_view dialect_hint(std::string_view text, ProgramError error, Dialect dialect) {
    const char first = TextCursor(text).peek();
    switch (error) {
    case ProgramError::m_code_unknown:
    case ProgramError::user_code_unsupported:
        return dialect != Dialect::marlin && is_printer_word(text)
                   ? "this dialect does not have the word; --dialect marlin does"
                   : "";
    case ProgramError::word_unused:
        return dialect != Dialect::marlin && first == 'e'
                   ? "E is the filament of a printer; --dialect marlin has it, and --ignore E leaves it out"
                   : "";
    case ProgramError::function_unknown:
        return is_call(text) ? "" : "the letter before it has no number; a word is a letter and a number, like X10";
    case ProgramError::character_invalid:
        if (first == ',' && text.size() > 1 && text[1] >= '0' && text[1] <= '9') {
            return "a number has a point, not a comma";
        }
        if (first == '$' && dialect != Dialect::grbl) {
            return "$ begins a command of grbl; --dialect grbl has $H";
        }
        if (first == '?' || first == '!' || first == '~' || first == '\x18') {
            return "grbl takes this byte as a command of the sender, at once; in a program write M0 to pause, or leave "
                   "it out";
        }
        return "";
    default: return "";
    }
}

} // namespace splinefeed::host
