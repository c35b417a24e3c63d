// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode_settings.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/nearest_name.hpp"
#include "host_sim/base/number_text.hpp"
#include "host_sim/base/option_number.hpp"
#include "host_sim/base/trimmed_text.hpp"
#include "splinefeed/s0_program/text/text_cursor.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>

namespace splinefeed::host {

namespace {

constexpr double largest_word = 3000.0;
constexpr int most_runs = 1'000'000;

bool is_letter(char c) {
    return c >= 'A' && c <= 'Z';
}

std::string in_capitals(std::string_view text) {
    std::string upper(text);
    std::ranges::transform(upper, upper.begin(), upper_case);
    return upper;
}

// "$*" or "START_PRINT": what no word of G-code begins with.
bool begins_line(std::string_view upper) {
    const auto is_name = [](char c) {
        return is_letter(c) || c == '_';
    };
    const std::size_t star = upper.find('*');
    return upper.size() > 1 && (star == std::string_view::npos || star + 1 == upper.size()) &&
           (upper[0] == '$' || (is_name(upper[0]) && (is_name(upper[1]) || upper[1] == '*')));
}

// "M104" or "E".
IgnoredWord ignored_word(std::string_view word) {
    IgnoredWord out;
    const std::string upper = in_capitals(word);
    out.letter = upper.empty() ? '\0' : upper.front();
    if (upper.size() == 1 && is_letter(out.letter)) {
        return out;
    }
    double number = -1.0;
    const bool numeric = !upper.empty() && read_number(std::string_view(upper).substr(1), number) == NumberText::number;
    const double tenths = numeric ? number * 10.0 : -1.0;
    if (!is_letter(out.letter) || !(tenths >= 0.0 && tenths <= 10.0 * largest_word) ||
        std::fabs(tenths - std::round(tenths)) > 1e-6) {
        throw UsageError(
            "--ignore: {} is no word; name words like M104,E, separated by commas, the first word of whole lines "
            "like START_PRINT or $*, or unknown",
            in_quotes(word));
    }
    out.tenths = static_cast<std::int16_t>(std::lround(tenths));
    return out;
}

} // namespace

std::string_view first_option(const GcodeArguments& arguments) noexcept {
    return arguments.dialect         ? "--dialect"
           : arguments.ignore        ? "--ignore"
           : arguments.tools         ? "--tools"
           : arguments.subprograms   ? "--subprograms"
           : arguments.repeat        ? "--repeat"
           : arguments.block_delete  ? "--block-delete"
           : arguments.optional_stop ? "--optional-stop"
           : arguments.increments    ? "--increments"
                                     : "";
}

GcodeSettings read_gcode_arguments(const GcodeArguments& arguments) {
    GcodeSettings out;
    if (arguments.dialect) {
        const auto* const found = std::ranges::find(dialect_names, std::string_view(*arguments.dialect));
        if (found == std::end(dialect_names)) {
            throw UsageError("--dialect {}: it must be one of {}", in_quotes(*arguments.dialect),
                             listed(dialect_names));
        }
        const bool guesses = *found == "auto";
        out.dialect_choice = guesses ? DialectChoice::first_lines : DialectChoice::option;
        out.dialect = guesses ? Dialect::linuxcnc : static_cast<Dialect>(found - std::begin(dialect_names));
    }
    const std::string ignored = arguments.ignore.value_or("");
    for (const std::string_view word : arguments.ignore ? split(ignored, ',') : std::vector<std::string_view>{}) {
        const std::string part = in_capitals(word);
        if (part == "UNKNOWN") {
            out.ignores_unknown = true;
        } else if (begins_line(part)) {
            out.ignored_lines.push_back(part);
        } else {
            out.ignored.push_back(ignored_word(word));
        }
    }
    if (arguments.tools) {
        out.tools = read_tool_file(*arguments.tools);
    }
    if (arguments.repeat) {
        out.runs = static_cast<std::uint64_t>(read_option_integer("--repeat", *arguments.repeat, 1, most_runs));
    }
    const std::string folders = arguments.subprograms.value_or("");
    for (const std::string_view folder :
         arguments.subprograms ? split(folders, ':') : std::vector<std::string_view>{}) {
        if (!std::filesystem::is_directory(folder)) {
            throw UsageError("--subprograms: {} is no folder; name folders, separated by colons", in_quotes(folder));
        }
        out.subprogram_folders.emplace_back(folder);
    }
    out.block_delete = arguments.block_delete;
    out.optional_stop = arguments.optional_stop;
    out.increments = arguments.increments;
    if (out.increments && out.dialect != Dialect::fanuc) {
        throw UsageError("--increments is of --dialect fanuc alone; the others read X10 as 10 mm");
    }
    return out;
}

} // namespace splinefeed::host
