// SPDX-License-Identifier: MIT
#include "host_sim/program/dialect_guess.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/program/line_filter.hpp"

#include "splinefeed/s0_program/dialects/dialect_rules.hpp"
#include "splinefeed/s0_program/text/text_cursor.hpp"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <iterator>
#include <vector>

namespace splinefeed::host {

namespace {

struct Sign {
    std::string_view text; // in lower case, without spaces
    Dialect dialect;
    int points;
};

// In comments. Senders and CAM systems name the post.
constexpr Sign comment_signs[] = {
    {"flavor:klipper", Dialect::klipper, 50},
    {"flavor=klipper", Dialect::klipper, 50},
    {"flavor:marlin", Dialect::marlin, 50},
    {"flavor=marlin", Dialect::marlin, 50},
    {"flavor:reprap", Dialect::marlin, 50},
    {"flavor=reprap", Dialect::marlin, 50},
    {"grbl", Dialect::grbl, 40},
    {"linuxcnc", Dialect::linuxcnc, 40},
    {"emc2", Dialect::linuxcnc, 40},
    {"fanuc", Dialect::fanuc, 40},
    {"haas", Dialect::fanuc, 40},
    {"shapeoko", Dialect::grbl, 10},
    {"x-carve", Dialect::grbl, 10},
    {"easel", Dialect::grbl, 10},
    {"carbide", Dialect::grbl, 10},
    {"slic3r", Dialect::marlin, 20},
    {"bambustudio", Dialect::marlin, 20},
    {"simplify3d", Dialect::marlin, 20},
    {"ideamaker", Dialect::marlin, 20},
    {"kisslicer", Dialect::marlin, 20},
    {"reprapfirmware", Dialect::marlin, 20},
    {"prusaslicer", Dialect::marlin, 20},
    {"cura_steamengine", Dialect::marlin, 20},
    {"orcaslicer", Dialect::marlin, 20},
    {"superslicer", Dialect::marlin, 20},
    {"arcwelder", Dialect::marlin, 20},
    {"klipper", Dialect::klipper, 10},
    {"marlin", Dialect::marlin, 10},
    {"lightburn", Dialect::grbl, 10},
};

// Words that only one of them has; each counts once a line.
constexpr Sign word_signs[] = {
    {"m104", Dialect::marlin, 6},  {"m109", Dialect::marlin, 6},    {"m140", Dialect::marlin, 6},
    {"m190", Dialect::marlin, 6},  {"m106", Dialect::marlin, 6},    {"m107", Dialect::marlin, 6},
    {"m82", Dialect::marlin, 6},   {"m83", Dialect::marlin, 6},     {"m84", Dialect::marlin, 6},
    {"m115", Dialect::marlin, 6},  {"m117", Dialect::marlin, 6},    {"m201", Dialect::marlin, 6},
    {"m203", Dialect::marlin, 6},  {"m204", Dialect::marlin, 6},    {"m205", Dialect::marlin, 6},
    {"m220", Dialect::marlin, 6},  {"m221", Dialect::marlin, 6},    {"m400", Dialect::marlin, 6},
    {"m862", Dialect::marlin, 6},  {"m900", Dialect::marlin, 6},    {"g92e", Dialect::marlin, 6},
    {"g64", Dialect::linuxcnc, 6}, {"m66", Dialect::linuxcnc, 6},   {"m62", Dialect::linuxcnc, 6},
    {"g15", Dialect::fanuc, 6},    {"g50", Dialect::fanuc, 6},      {"g69", Dialect::fanuc, 6},
    {"g28u", Dialect::fanuc, 6},   {"g28w", Dialect::fanuc, 6},     {"g28v", Dialect::fanuc, 6},
    {"g154", Dialect::fanuc, 6},   {"g65", Dialect::fanuc, 6},      {"m97", Dialect::fanuc, 6},
    {"g187", Dialect::fanuc, 6},   {"m98", Dialect::fanuc, 3},      {"m99", Dialect::fanuc, 3},
    {"m73", Dialect::marlin, 6},   {"m486", Dialect::marlin, 6},    {"m92", Dialect::marlin, 6},
    {"m17", Dialect::marlin, 6},   {"m18", Dialect::marlin, 6},     {"m300", Dialect::marlin, 6},
    {"m64", Dialect::linuxcnc, 3}, {"m65", Dialect::linuxcnc, 3},   {"m67", Dialect::linuxcnc, 6},
    {"m68", Dialect::linuxcnc, 6}, {"g33.1", Dialect::linuxcnc, 6}, {"m888", Dialect::marlin, 6},
    {"m2000", Dialect::marlin, 6}, {"m280", Dialect::marlin, 6},    {"m420", Dialect::marlin, 6},
    {"m500", Dialect::marlin, 6},  {"m501", Dialect::marlin, 6},    {"m502", Dialect::marlin, 6},
    {"m906", Dialect::marlin, 6},
};

// What a line of a macro begins with behind its number. No other dialect reads such a program, whatever else it has.
constexpr std::string_view macro_signs[] = {"if[", "while[", "g65p", "m97p", "#3000=", "#3006="};
constexpr int macro_points = 2000;

bool is_figure(char c) noexcept {
    return c >= '0' && c <= '9';
}

std::string plain(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c != ' ' && c != '\t' && c != '\r') {
            out += lower_case(c);
        }
    }
    return out;
}

// Not within another word: g15 is not in g150.
bool has_word(std::string_view code, std::string_view word) noexcept {
    for (std::size_t at = code.find(word); at != std::string_view::npos; at = code.find(word, at + 1)) {
        const char behind = at + word.size() < code.size() ? code[at + word.size()] : '\0';
        if (!is_figure(word.back()) || (!is_figure(behind) && behind != '.')) {
            return true;
        }
    }
    return false;
}

/// G28 X: a letter without its number; or a G5 alone, which slicers write where nothing else stands.
bool is_bare(std::string_view plain) noexcept {
    const std::size_t at = plain.find("g28");
    const std::size_t letter = at == std::string_view::npos ? at : plain.find_first_of("xyz", at);
    return plain == "g5" || (letter != std::string_view::npos &&
                             (letter + 1 == plain.size() || (plain[letter + 1] >= 'a' && plain[letter + 1] <= 'z')));
}

// The number of each G word, without zeros in front; 0 for G0.
std::vector<int> g_numbers(std::string_view plain) {
    std::vector<int> out;
    for (std::size_t at = plain.find('g'); at != std::string_view::npos; at = plain.find('g', at + 1)) {
        int number = 0;
        std::from_chars(plain.data() + at + 1, plain.data() + plain.size(), number);
        out.push_back(number);
    }
    return out;
}

bool is_motion(int g) noexcept {
    return g <= 3 || g == 5 || g == 33 || g == 38 || (g >= 73 && g <= 89 && g != 80);
}

std::string_view behind_number(std::string_view code) noexcept {
    return code.front() == 'n' ? code.substr(std::min(code.find_first_not_of("0123456789", 1), code.size())) : code;
}

bool is_macro(std::string_view code) noexcept {
    code = behind_number(code);
    return std::ranges::any_of(macro_signs, [&](std::string_view sign) { return code.starts_with(sign); });
}

} // namespace

void DialectGuess::count(Dialect dialect, int points, std::string_view text, std::uint64_t line) {
    Evidence& of = evidence_[static_cast<std::size_t>(dialect)];
    of.points += points;
    if (points > of.best) {
        of.best = points;
        of.line = line;
        of.text = std::string(text.substr(0, text.find_last_not_of(" \t\r") + 1));
    }
}

void DialectGuess::read_comment(std::string_view comment, std::uint64_t line) {
    const std::string text = plain(comment);
    for (const Sign& sign : comment_signs) {
        if (text.find(sign.text) != std::string::npos) {
            count(sign.dialect, sign.points, comment, line);
        }
    }
}

void DialectGuess::read_words(std::string_view code, std::string_view macro, std::uint64_t line) {
    const std::string text = plain(code);
    if (text.empty()) {
        return;
    }
    readings_.add(code, text, line);
    percent_ = percent_ || text == "%";
    if (!macro.empty() && (macro.find('_') != std::string_view::npos || is_still_macro(macro))) {
        count(Dialect::klipper, 20, macro, line);
        return;
    }
    if (is_macro(text)) {
        count(Dialect::fanuc, macro_points, code, line);
        return;
    }
    if (text[0] == '$') {
        count(Dialect::grbl, 20, code, line);
        return;
    }
    // A number of the program, and nothing else, is Fanuc's; LinuxCNC takes it, too.
    const bool numbered =
        text.size() > 1 && (text[0] == 'o' || text[0] == ':') && std::all_of(text.begin() + 1, text.end(), is_figure);
    if (numbered) {
        count(Dialect::fanuc, percent_ ? 5 : 3, code, line);
    } else if (text[0] == 'o' || text.find("#<") != std::string::npos) {
        count(Dialect::linuxcnc, 6, code, line);
        return;
    } else if (text[0] == '#' || text.find('[') != std::string::npos) { // Fanuc's where something else says so
        count(Dialect::linuxcnc, 3, code, line);
        return;
    }
    for (const Sign& sign : word_signs) {
        if (has_word(text, sign.text)) {
            count(sign.dialect, sign.points, code, line);
        }
    }
    if (is_bare(text) && evidence_[static_cast<std::size_t>(Dialect::marlin)].points == 0) { // the next says no more
        count(Dialect::marlin, 5, code, line);
    }
    if (has_lathe_tool(text)) {
        count(Dialect::fanuc, 5, code, line);
    }
    read_motion(code, text, line);
    const bool moves = has_word(text, "g1") || has_word(text, "g0") || has_word(text, "g01") || has_word(text, "g00");
    const std::size_t filament = code.find_first_of("eE");
    if (moves && filament != std::string_view::npos && filament > 0 && code[filament - 1] == ' ') { // no exponent
        count(Dialect::marlin, 6, code, line);
    }
}

// What LinuxCNC refuses and another one takes, where nothing else says whose the program is.
void DialectGuess::count_if_free(Dialect dialect, std::string_view text, std::uint64_t line) {
    if (std::ranges::all_of(evidence_, [](const Evidence& of) { return of.points == 0; })) {
        count(dialect, enough, text, line);
    }
}

// Axis words without a motion word in effect: grbl begins with G0, and on Fanuc's controls G80 leaves the motion from
// before it. An arc with all of I, J and K: grbl reads over the one across its plane.
void DialectGuess::read_motion(std::string_view code, std::string_view plain, std::uint64_t line) {
    const std::vector<int> numbers = g_numbers(plain);
    const bool moves = std::ranges::any_of(numbers, is_motion);
    const bool ends = std::ranges::count(numbers, 80) > 0 && !moves;
    motion_ = moves ? Motion::stated : ends && motion_ == Motion::stated ? Motion::ended : motion_;
    const std::string_view words = behind_number(plain);
    if (numbers.empty() && words.size() > 1 && words[0] >= 'x' && words[0] <= 'z' && motion_ != Motion::stated) {
        count_if_free(motion_ == Motion::ended ? Dialect::fanuc : Dialect::grbl, code, line);
        motion_ = Motion::stated;
    }
    const bool is_arc = std::ranges::any_of(numbers, [](int g) { return g == 2 || g == 3; });
    if (is_arc &&
        std::ranges::all_of(std::string_view("ijk"), [&](char c) { return plain.find(c) != std::string_view::npos; })) {
        count_if_free(Dialect::grbl, code, line);
    }
}

void DialectGuess::add(std::string_view line, std::uint64_t number) {
    std::string code;
    for (std::size_t at = 0; at < line.size(); ++at) {
        if (line[at] == ';') {
            read_comment(line.substr(at), number);
            break;
        }
        if (line[at] == '(') {
            const std::size_t end = std::min(line.find(')', at), line.size());
            read_comment(line.substr(at, end + 1 - at), number);
            if (line.substr(at + 1, end - at).find('(') != std::string_view::npos) {
                count_if_free(Dialect::grbl, line, number);
            }
            at = end;
            continue;
        }
        code += line[at];
    }
    read_words(code, macro_name(line), number); // NAME(...) is a call of another control
}

Dialect DialectGuess::dialect() const noexcept {
    const auto* const best = std::ranges::max_element(evidence_, {}, &Evidence::points);
    return best->points < enough ? Dialect::linuxcnc : static_cast<Dialect>(best - evidence_.begin());
}

std::string DialectGuess::differences(Dialect taken) const {
    const Evidence& best = evidence_[static_cast<std::size_t>(taken)];
    if (best.best >= named) {
        return {};
    }
    std::vector<Dialect> others;
    for (std::size_t i = 0; i < dialects; ++i) {
        const auto other = static_cast<Dialect>(i);
        if (other != taken && (evidence_[i].points > 0 || (best.best <= enough && !rules_of(other).extruder))) {
            others.push_back(other);
        }
    }
    return readings_.differences(taken, others);
}

std::string DialectGuess::reason() const {
    const Evidence& best = evidence_[static_cast<std::size_t>(dialect())];
    return best.points < enough ? std::string() : fmt::format("{} on line {}", in_quotes(best.text), best.line);
}

} // namespace splinefeed::host
