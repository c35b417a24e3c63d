// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/dialect_hint.hpp"

#include "host_sim/program/kept_line.hpp"

#include "splinefeed/s0_program/dialects/code_table.hpp"
#include "splinefeed/s0_program/dialects/dialect_rules.hpp"
#include "splinefeed/s0_program/text/decimal.hpp"
#include "splinefeed/s0_program/text/decimal_text.hpp"
#include "splinefeed/s0_program/text/text_cursor.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace splinefeed::host {

namespace {

/// A G or M word that text begins with.
struct CodeWord {
    char letter = 'm';
    std::int32_t tenths = 0;

    [[nodiscard]] CodeInfo in(Dialect dialect) const noexcept {
        return letter == 'g' ? find_g_code(tenths, dialect) : find_m_code(tenths / 10, dialect);
    }
};

std::optional<CodeWord> code_of(std::string_view text) {
    constexpr std::int64_t tenth = Decimal::one / 10;
    constexpr std::int64_t most = 10'000;
    TextCursor cursor(text);
    const char letter = cursor.peek();
    Decimal number;
    cursor.step();
    if ((letter != 'g' && letter != 'm') || !read_decimal(cursor, number).ok() || number.raw % tenth != 0 ||
        number.raw < 0 || number.raw / Decimal::one > most) {
        return std::nullopt;
    }
    return CodeWord{letter, static_cast<std::int32_t>(number.raw / tenth)};
}

// With P or Q it is another control's: a user code, or the material of a plasma table (M190 P2).
bool is_printer_word(std::string_view text) {
    const std::optional<CodeWord> code = code_of(text);
    if (!code || code->letter != 'm' || code->tenths % 10 != 0 ||
        text.substr(0, text.find_first_of("(;")).find_first_of("pPqQ") != std::string_view::npos) {
        return false;
    }
    const CodeInfo info = code->in(Dialect::marlin);
    return info.group == CodeGroup::printer && info.refusal == ProgramError::none;
}

std::string_view arc_hint(const ArcTolerance& tolerance) {
    if (!tolerance.relative) {
        return "the centre is nearer to one end: radii may differ by 0.5 mm";
    }
    return tolerance.most > Decimal::from_integer(1)
               ? "the centre is nearer to one end: radii may differ by 0.0283 mm (in inches 0.0718 mm) or 0.1 %"
               : "the centre is nearer to one end: radii may differ by 0.005 mm or 0.1 %, and at most by 0.5 mm";
}

/// Whether text begins like a call of a function: a name and a bracket.
bool is_call(std::string_view text) {
    const std::size_t end = text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ \t");
    return end != std::string_view::npos && text[end] == '[';
}

constexpr std::pair<ProgramError, std::string_view> helping_options[] = {
    {ProgramError::not_in_dialect, "; that of linuxcnc has it"},
    {ProgramError::axis_missing, "; --ignore leaves the letter out"},
    {ProgramError::tool_table_missing, "; --tools gives one"},
    {ProgramError::m_code_unknown, "; --ignore leaves such a word out"},
    {ProgramError::user_code_unsupported, "; --ignore leaves such a word out"},
    {ProgramError::bed_levelling_unsupported, "; --ignore G29 leaves it out"},
    {ProgramError::firmware_retraction_unsupported, "; --ignore G10,G11 leaves it out"},
    {ProgramError::printer_move_unsupported, "; --ignore leaves the word out"},
    {ProgramError::grbl_command_unsupported, "; --ignore $* leaves all of them out"},
};

// In the place of the core's, which a firmware has to hold.
constexpr std::pair<ProgramError, std::string_view> full_sentences[] = {
    {ProgramError::lathe_word, "it is a lathe's: T0101, G50 S, G99 with a small F, G90, G92 or G94 as a cycle; read as "
                               "a mill's, the program would move elsewhere"},
    {ProgramError::coordinates_unsupported,
     "it turns, scales, mirrors or shifts coordinates, which is not supported; let the post write plain moves"},
    {ProgramError::macro_unsupported, "calls of macros and jumps are not supported; use subprograms, O words or M98"},
    {ProgramError::printer_flow_unsupported, "loops, macros, other files and ends of a print are not supported"},
    {ProgramError::pocket_unsupported, "circular pockets are not supported; program them as arcs"},
    {ProgramError::ignored_word_counts,
     "what changes the path, its place or the order of the blocks is never left out; take the word out of the list"},
};

std::string_view full_sentence(ProgramError error) {
    for (const auto& [refused, text] : full_sentences) {
        if (refused == error) {
            return text;
        }
    }
    return describe(error);
}

/// Why --ignore does not take the word, where it would be advised or was tried. Empty: it does.
std::string kept_advice(std::string_view text, ProgramError error, const GcodeSettings& settings) {
    const std::optional<CodeWord> code = code_of(text);
    const CodeEffect effect = code ? code->in(settings.dialect).effect : CodeEffect::machine;
    const bool tried = settings.ignores_unknown || std::ranges::any_of(settings.ignored, [&](const IgnoredWord& word) {
                           return code && word.letter == upper_case(code->letter) && word.tenths == code->tenths;
                       });
    const bool advised = option_advice(error).find("--ignore") != std::string_view::npos;
    return may_be_left_out(effect) || error == ProgramError::ignored_word_counts || !(tried || advised)
               ? std::string()
               : fmt::format("; {}, so that no --ignore leaves it out", effect_text(effect));
}

} // namespace

std::string_view dialect_hint(std::string_view text, ProgramError error, Dialect dialect) {
    const char first = TextCursor(text).peek();
    const DialectRules& rules = rules_of(dialect);
    switch (error) {
    case ProgramError::m_code_unknown:
    case ProgramError::not_in_dialect:
    case ProgramError::user_code_unsupported:
        return dialect != Dialect::fanuc && !rules.extruder && is_printer_word(text)
                   ? "this dialect does not have the word; --dialect marlin does"
                   : "";
    case ProgramError::word_unused:
        return !rules.extruder && first == 'e'
                   ? "E is the filament of a printer; --dialect marlin has it, and --ignore E leaves it out"
                   : "";
    case ProgramError::function_unknown:
        return is_call(text) ? "" : "the letter before it has no number; a word is a letter and a number, like X10";
    case ProgramError::character_invalid:
        if (first == ',' && text.size() > 1 && text[1] >= '0' && text[1] <= '9') {
            return "a number has a point, not a comma";
        }
        if (first == '$' && !rules.dollar_lines) {
            return "$ begins a command of grbl; --dialect grbl has $H, and --ignore $* leaves such lines out";
        }
        if (first == '?' || first == '!' || first == '~' || first == '\x18') {
            return "grbl takes this byte as a command of the sender, at once; in a program write M0 to pause; --ignore "
                   "$*,unknown leaves such lines out";
        }
        return "";
    case ProgramError::bed_levelling_unsupported: {
        const std::optional<CodeWord> code = code_of(text);
        return code && code->tenths == 260 ? "it prints a pattern of its own to test the mesh of the bed, which is "
                                             "not supported; --ignore G26 "
                                             "leaves it out"
                                           : "";
    }
    case ProgramError::arc_radius_mismatch: return arc_hint(rules.arc);
    case ProgramError::dwell_invalid:
        return rules.dwell == DwellUnit::millisecond ? "a dwell needs P, its milliseconds, and P is at least 0"
                                                     : "a dwell needs P, its seconds, and P is at least 0";
    case ProgramError::axis_missing:
        return first >= 'u' && first <= 'w' && !rules.uvw_steps
                   ? "the machine has no such axis, and U, V and W are no steps of X, Y and Z in this dialect"
                   : "";
    default: return "";
    }
}

std::string_view option_advice(ProgramError error) {
    for (const auto& [refused, text] : helping_options) {
        if (refused == error) {
            return text;
        }
    }
    return {};
}

std::string refusal_sentence(std::string_view text, ProgramError error, const GcodeSettings& settings) {
    if (const std::string_view hint = dialect_hint(text, error, settings.dialect); !hint.empty()) {
        return std::string(hint);
    }
    const std::string kept = kept_advice(text, error, settings);
    return std::string(full_sentence(error)).append(kept.empty() ? option_advice(error) : kept);
}

} // namespace splinefeed::host
