// SPDX-License-Identifier: MIT
#include "host_sim/program/line_filter.hpp"

#include "host_sim/program/kept_line.hpp"

#include "splinefeed/s0_program/dialects/dialect_rules.hpp"
#include "splinefeed/s0_program/text/text_cursor.hpp"

#include <algorithm>
#include <iterator>

namespace splinefeed::host {

namespace {

bool begins_name(char c) noexcept {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

bool is_in_name(char c) noexcept {
    return begins_name(c) || c == '_' || (c >= '0' && c <= '9');
}

std::string_view without_spaces(std::string_view line) noexcept {
    const std::size_t begin = line.find_first_not_of(" \t");
    return begin == std::string_view::npos ? std::string_view() : line.substr(begin);
}

std::string_view first_word(std::string_view line) noexcept {
    const std::string_view text = without_spaces(line);
    return text.substr(0, text.find_first_of(" \t;(\r"));
}

// Of Klipper and its usual companions. Those that move or shift something are not among them.
constexpr std::string_view still_macros[] = {
    "EXCLUDE_OBJECT_DEFINE",
    "EXCLUDE_OBJECT_START",
    "EXCLUDE_OBJECT_END",
    "EXCLUDE_OBJECT",
    "SET_VELOCITY_LIMIT",
    "SET_PRESSURE_ADVANCE",
    "SET_PRINT_STATS_INFO",
    "SET_HEATER_TEMPERATURE",
    "TEMPERATURE_WAIT",
    "SET_FAN_SPEED",
    "SET_RETRACTION",
    "SET_LED",
    "SET_INPUT_SHAPER",
    "SET_PIN",
    "RESPOND",
    "TIMELAPSE_TAKE_FRAME",
    "TURN_OFF_HEATERS",
    "_TOOLCHANGE",
    "SET_DISPLAY_TEXT",
    "SET_FILAMENT_SENSOR",
};

} // namespace

std::string_view macro_name(std::string_view line) noexcept {
    const std::string_view text = without_spaces(line);
    if (text.size() < 2 || !(begins_name(text[0]) || text[0] == '_') || !(begins_name(text[1]) || text[1] == '_')) {
        return {};
    }
    const auto* const end = std::ranges::find_if_not(text, is_in_name);
    const auto size = static_cast<std::size_t>(end - text.begin());
    // X SIN[30] is a word, and so is an O word.
    const bool calls = size < text.size() && (text[size] == '[' || text[size] == '#' || text[size] == '<');
    const char after = size < text.size() ? text[size] : '\0';
    return calls || !(after == '\0' || after == ' ' || after == '\t' || after == ';' || after == '=' || after == '\r')
               ? std::string_view()
               : text.substr(0, size);
}

bool fits(std::string_view pattern, std::string_view word) noexcept {
    const bool open = !pattern.empty() && pattern.back() == '*';
    pattern.remove_suffix(open ? 1 : 0);
    if (open ? word.size() < pattern.size() : word.size() != pattern.size()) {
        return false;
    }
    return std::equal(pattern.begin(), pattern.end(), word.begin(),
                      [](char a, char b) { return upper_case(a) == upper_case(b); });
}

bool is_still_macro(std::string_view name) noexcept {
    return std::ranges::any_of(still_macros, [&](std::string_view macro) { return fits(macro, name); });
}

std::string_view left_out_line(std::string_view line, const GcodeSettings& settings) noexcept {
    const std::string_view word = first_word(line);
    if (word.empty() || kept_line(line)) {
        return {};
    }
    const std::string_view name = macro_name(line);
    const std::string_view told = name.empty() ? word : name;
    for (const std::string& pattern : settings.ignored_lines) {
        if (fits(pattern, told)) {
            return told;
        }
    }
    const DialectRules& rules = rules_of(settings.dialect);
    const bool homing = rules.dollar_lines && fits("$H", word);
    const bool foreign =
        !name.empty() || (word[0] == '$' && !homing) || word[0] == '?' || word[0] == '!' || word[0] == '~';
    const bool still = has_macros(settings.dialect) && is_still_macro(name);
    return still || (settings.ignores_unknown && foreign) ? told : std::string_view();
}

} // namespace splinefeed::host
