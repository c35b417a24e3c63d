// SPDX-License-Identifier: MIT
#include "host_sim/program/kept_line.hpp"

#include "host_sim/base/input_error.hpp"

#include "splinefeed/s0_program/text/text_cursor.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

struct KeptWord {
    std::string_view name; // in capitals; a # at its end is a number that must be there
    CodeEffect effect;
};

// A number may stand behind each: GOTO10, CYCLE81.
constexpr KeptWord kept_words[] = {
    // Macros of Fanuc, Siemens and others.
    {"IF", CodeEffect::flow},
    {"ELSEIF", CodeEffect::flow},
    {"ELSE", CodeEffect::flow},
    {"ENDIF", CodeEffect::flow},
    {"WHILE", CodeEffect::flow},
    {"ENDWHILE", CodeEffect::flow},
    {"DO#", CodeEffect::flow},
    {"END#", CodeEffect::flow},
    {"GOTO", CodeEffect::flow},
    {"GOTOF", CodeEffect::flow},
    {"GOTOB", CodeEffect::flow},
    {"FOR", CodeEffect::flow},
    {"ENDFOR", CodeEffect::flow},
    {"LOOP", CodeEffect::flow},
    {"ENDLOOP", CodeEffect::flow},
    {"REPEAT", CodeEffect::flow},
    {"REPEATB", CodeEffect::flow},
    {"UNTIL", CodeEffect::flow},
    {"CALL", CodeEffect::flow},
    {"MCALL", CodeEffect::flow},
    {"CYCLE#", CodeEffect::motion},
    {"TRANS", CodeEffect::coordinates},
    {"ATRANS", CodeEffect::coordinates},
    {"ROT", CodeEffect::coordinates},
    {"AROT", CodeEffect::coordinates},
    {"SCALE", CodeEffect::coordinates},
    {"ASCALE", CodeEffect::coordinates},
    {"MIRROR", CodeEffect::coordinates},
    {"AMIRROR", CodeEffect::coordinates},
    {"TRAORI", CodeEffect::coordinates},
    {"TRANSMIT", CodeEffect::coordinates},
    {"TRACYL", CodeEffect::coordinates},
    {"DIAMON", CodeEffect::coordinates},
    // Klipper.
    {"SDCARD_LOOP_BEGIN", CodeEffect::flow},
    {"SDCARD_LOOP_END", CodeEffect::flow},
    {"SDCARD_LOOP_DESIST", CodeEffect::flow},
    {"SDCARD_PRINT_FILE", CodeEffect::flow},
    {"FORCE_MOVE", CodeEffect::motion},
    {"MANUAL_STEPPER", CodeEffect::motion},
    {"SET_GCODE_OFFSET", CodeEffect::coordinates},
    {"SAVE_GCODE_STATE", CodeEffect::coordinates},
    {"RESTORE_GCODE_STATE", CodeEffect::coordinates},
    {"SET_KINEMATIC_POSITION", CodeEffect::coordinates},
    {"SET_SKEW", CodeEffect::coordinates},
    {"SKEW_PROFILE", CodeEffect::coordinates},
    {"SET_DUAL_CARRIAGE", CodeEffect::coordinates},
    {"ACTIVATE_EXTRUDER", CodeEffect::coordinates},
    // grbl: a jog, and offsets that are lost.
    {"$J", CodeEffect::motion},
    {"$RST", CodeEffect::coordinates},
};

bool is_digit_of_name(char c) noexcept {
    return c >= '0' && c <= '9';
}

bool is_letter_of_name(char c) noexcept {
    return (upper_case(c) >= 'A' && upper_case(c) <= 'Z') || c == '_';
}

bool is_same(std::string_view name, std::string_view word) noexcept {
    return std::equal(name.begin(), name.end(), word.begin(), word.end(),
                      [](char a, char b) { return a == upper_case(b); });
}

// Behind spaces, a / and an N number.
std::string_view without_number(std::string_view line) noexcept {
    TextCursor cursor(line);
    cursor.take('/');
    if (cursor.peek() == 'n' && is_digit_of_name(cursor.peek_second())) {
        cursor.step();
        while (is_digit_of_name(cursor.peek())) {
            cursor.step();
        }
    }
    return line.substr(std::min(cursor.at(), line.size()));
}

} // namespace

std::optional<KeptLine> kept_line(std::string_view line) noexcept {
    const std::string_view text = without_number(line);
    if (text.size() < 2 || !is_letter_of_name(text[1]) ||
        (!is_letter_of_name(text[0]) && text[0] != '$')) { // most lines
        return std::nullopt;
    }
    const auto* const end = std::find_if_not(text.begin() + 1, text.end(), is_letter_of_name);
    const auto* const behind = std::find_if_not(end, text.end(), is_digit_of_name);
    const std::string_view letters = text.substr(0, static_cast<std::size_t>(end - text.begin()));
    for (const KeptWord& word : kept_words) {
        const bool numbered = word.name.back() == '#';
        if ((!numbered || behind != end) &&
            is_same(word.name.substr(0, word.name.size() - (numbered ? 1U : 0U)), letters)) {
            return KeptLine{text.substr(0, static_cast<std::size_t>(behind - text.begin())), word.effect};
        }
    }
    return std::nullopt;
}

std::string_view effect_text(CodeEffect effect) noexcept {
    switch (effect) {
    case CodeEffect::flow: return "it changes the order of the blocks";
    case CodeEffect::coordinates: return "it changes where the path lies";
    default: return "it may move the machine, or change how it moves";
    }
}

std::string refusal(const KeptLine& line) {
    return fmt::format("{}: {}, and is not supported; no --ignore leaves such a line out{}", in_quotes(line.word),
                       effect_text(line.effect),
                       line.effect == CodeEffect::flow ? ". O words have conditions and loops" : "");
}

} // namespace splinefeed::host
