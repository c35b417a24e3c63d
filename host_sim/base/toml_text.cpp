// SPDX-License-Identifier: MIT
#include "host_sim/base/toml_text.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/number_text.hpp"
#include "host_sim/base/trimmed_text.hpp"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

// A table in a table for each: the parser makes them, and gives them back, by calling itself.
constexpr int most_dots = 16;

bool starts_key(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') ||
           std::string_view("_-\"']").find(c) != std::string_view::npos;
}

// The text behind '[' at the start of a line: a name, after a second '[' perhaps.
bool names_table(std::string_view rest) {
    constexpr std::string_view blanks = " \t";
    std::size_t at = rest.find_first_not_of(blanks);
    if (at < rest.size() && rest[at] == '[') {
        at = rest.find_first_not_of(blanks, at + 1);
    }
    return at < rest.size() && starts_key(rest[at]);
}

// Whether a line begins like `name = `, so that what follows can only be a value.
bool assigns(std::string_view line) {
    constexpr std::string_view blanks = " \t";
    const std::size_t key = line.find_first_not_of(blanks);
    const std::size_t end = line.find_first_of(blanks, key);
    const std::size_t equals = line.find_first_not_of(blanks, end);
    if (key >= line.size() || end >= line.size() || equals >= line.size() || line[equals] != '=') {
        return false;
    }
    for (const char c : line.substr(key, end - key)) {
        if (!starts_key(c) || c == '"' || c == '\'' || c == ']') {
            return false;
        }
    }
    return line.find_first_not_of(blanks, equals + 1) == std::string_view::npos;
}

bool blank_of_toml(char c) {
    return c == ' ' || c == '\t';
}

// What is wrong with a character outside of comments and texts; empty: nothing. `rest` begins with it.
std::string wrong_mark(std::string_view rest, int dots, bool line_starts, char before) {
    if (dots > most_dots) {
        return fmt::format("a name has more than {} parts, like a.b.c", most_dots + 1);
    }
    if (rest[0] == '[' && line_starts && !names_table(rest.substr(1))) {
        return "after [ there must be the name of a table: [path] or [[axis]]";
    }
    if (rest[0] == '}' && (before == '[' || before == ',' || before == '=')) {
        return "there is a } where a value should be; write one, or close what was opened";
    }
    return {};
}

void require_plain_toml(std::string_view toml, const std::string& file) {
    enum class Inside : char { nothing = 0, comment = '#', text = '"', literal = '\'' };
    Inside inside = Inside::nothing;
    bool any_letter = false; // not only ASCII
    bool line_starts = true;
    int dots = 0;       // in the key that is being read, or in a number
    char before = '\n'; // the last character that is neither blank nor in a comment or text
    std::size_t line_begin = 0;
    std::uint64_t line = 1;
    for (std::size_t i = toml.substr(0, 3) == "\xef\xbb\xbf" ? 3 : 0; i < toml.size(); ++i) {
        const char c = toml[i];
        if (c == '\n') {
            ++line;
            line_begin = i + 1;
            dots = 0;
            line_starts = true;
            inside = inside == Inside::comment ? Inside::nothing : inside;
            continue;
        }
        if (static_cast<unsigned char>(c) >= 0x80 && inside != Inside::comment &&
            !(inside != Inside::nothing && any_letter)) {
            throw InputError(file, line,
                             "letters beyond ASCII may stand in comments and in texts like name = \"...\" only");
        }
        if (inside == Inside::nothing) {
            constexpr std::string_view ends_key = "=,[]{}";
            dots = ends_key.find(c) != std::string_view::npos ? 0 : dots + (c == '.' ? 1 : 0);
            if (const std::string what = wrong_mark(toml.substr(i), dots, line_starts, before); !what.empty()) {
                throw InputError(file, line, what);
            }
            before = blank_of_toml(c) || c == '\r' || c == '#' ? before : c;
            if (c == '#' || c == '"' || c == '\'') {
                inside = static_cast<Inside>(c);
                any_letter = assigns(toml.substr(line_begin, i - line_begin));
            }
        } else if (inside != Inside::comment && c == static_cast<char>(inside)) {
            inside = Inside::nothing;
        } else if (inside == Inside::text && c == '\\') {
            i += i + 1 < toml.size() && toml[i + 1] != '\n' ? 1U : 0U;
        }
        line_starts = line_starts && blank_of_toml(c);
    }
}

/// What is wrong with a line, in the user's words where they can be found.
InputError toml_error(std::string_view toml, const std::string& file, std::uint64_t line,
                      std::string_view description) {
    for (std::uint64_t i = 1; i < line && !toml.empty(); ++i) {
        toml.remove_prefix(std::min(toml.find('\n'), toml.size() - 1) + 1);
    }
    const std::string_view text = trimmed(toml.substr(0, toml.find('\n')));
    const std::size_t equals = text.find('=');
    const std::string_view key = trimmed(text.substr(0, equals));
    const std::string_view value = equals == std::string_view::npos ? "" : trimmed(text.substr(equals + 1));
    const std::string_view number = value.substr(0, value.find_first_not_of("+-.0123456789eE"));
    const std::string_view rest = value.substr(number.size());
    const std::string_view bare = trimmed(value.substr(0, value.find('#'))); // without a comment
    double ignored = 0.0;
    const NumberText read = read_number(number, ignored);
    if (read == NumberText::out_of_range && bare == number) {
        return {file, line, fmt::format("{} = {} {}", key, number, why_no_number(read))};
    }
    const bool begins_with_number = read == NumberText::number;
    if (begins_with_number && rest.size() > 1 && rest[0] == ',' && rest[1] >= '0' && rest[1] <= '9') {
        return {file, line, fmt::format("a number has a point, not a comma: {} = {}.{}", key, number, rest.substr(1))};
    }
    if (begins_with_number && !rest.empty() && rest[0] != '#') {
        return {file, line,
                fmt::format("behind the number stands {}; write the number alone: {} = {}", in_quotes(trimmed(rest)),
                            key, number)};
    }
    for (const std::string_view flag : {"true", "false"}) {
        if (std::ranges::equal(bare, flag, [](char a, char b) { return (a | 0x20) == b; })) { // in any case
            return {file, line, fmt::format("{} is written with small letters: {} = {}", flag, key, flag)};
        }
    }
    if (!value.empty() &&
        ((value[0] >= 'a' && value[0] <= 'z') || (value[0] >= 'A' && value[0] <= 'Z') || value[0] == '/')) {
        return {file, line, fmt::format("a text stands in quotes: {} = \"{}\"", key, bare)};
    }
    if (text.substr(0, 1) == "[" && text.find(']') == std::string_view::npos) {
        return {file, line, fmt::format("the name of a table ends with ]: {}]", text)};
    }
    const std::size_t colon = description.find(": "); // "Error while parsing value: WHY"
    const std::string_view why = colon == std::string_view::npos ? description : description.substr(colon + 2);
    return {file, line, fmt::format("{} is no line of a .toml file: {}", in_quotes(text), why)};
}

} // namespace

toml::table parse_toml(std::string_view toml, const std::string& file) {
    require_plain_toml(toml, file);
    try {
        return toml::parse(toml, file);
    } catch (const toml::parse_error& error) {
        throw toml_error(toml, file, error.source().begin.line, error.description());
    }
}

} // namespace splinefeed::host
