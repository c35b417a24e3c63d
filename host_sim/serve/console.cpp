// SPDX-License-Identifier: MIT
#include "host_sim/serve/console.hpp"

#include "host_sim/base/number_text.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <iterator>
#include <sstream>
#include <vector>

namespace splinefeed::host {

namespace {

constexpr std::string_view jog_use = "write: jog AXIS MM [FEED], for example jog x 10, or jog z -0.5 300 (mm/min)\n";

struct Word {
    std::string_view name;
    std::string_view bytes;
    bool stops;
    std::string_view help;
};
constexpr Word words[] = {
    {"status", "?", true, "where the machine stands, and what it does"},
    {"hold", "!", true, "brake on the path; resume goes on"},
    {"resume", "~", false, "go on"},
    {"reset", "\x18", true, "brake, and forget the program; twice: stop at once"},
    {"cancel", "\x85", true, "end a jog"},
    {"single", "\x89", false, "block by block, on or off: resume executes the next line"},
    {"home", "$H\n", false, "home all axes"},
    {"unlock", "$X\n", false, "end an alarm"},
    {"settings", "$$\n", false, "the machine's numbers"},
    {"offsets", "$#\n", false, "work offsets and the last probe"},
};

std::string help() {
    std::string out = "a line of G-code or a $ line, or one of\n";
    for (const Word& word : words) {
        out += fmt::format("  {:<10}{}\n", word.name, word.help);
    }
    out += "  jog       AXIS MM [FEED]: move an axis by so much\n  quit      end the server\n";
    return out;
}

// Relative, in mm.
ConsoleOrder jog(const std::vector<std::string>& typed) {
    double mm = 0.0;
    double feed = 600.0;
    const bool numbers = typed.size() >= 3 && typed.size() <= 4 && typed[1].size() == 1 &&
                         read_number(typed[2], mm) == NumberText::number &&
                         (typed.size() < 4 || read_number(typed[3], feed) == NumberText::number);
    if (!numbers) {
        return {.text = std::string(jog_use)};
    }
    return {.bytes = fmt::format("$J=G21 G91 {}{:.4f} F{:.3f}\n",
                                 static_cast<char>(std::toupper(static_cast<unsigned char>(typed[1][0]))), mm, feed)};
}

} // namespace

ConsoleOrder console_order(std::string_view line) {
    std::istringstream stream{std::string(line)};
    const std::vector<std::string> typed{std::istream_iterator<std::string>(stream), {}};
    if (typed.empty()) {
        return {};
    }
    if (typed[0] == "jog") {
        return jog(typed);
    }
    if (typed.size() == 1 && (typed[0] == "help" || typed[0] == "?")) {
        return {.text = help()};
    }
    if (typed.size() == 1 && (typed[0] == "quit" || typed[0] == "exit")) {
        return {.leaves = true};
    }
    const auto* const word =
        std::find_if(std::begin(words), std::end(words), [&](const Word& row) { return row.name == typed[0]; });
    if (word != std::end(words) && typed.size() == 1) {
        return {.bytes = std::string(word->bytes), .stops = word->stops};
    }
    return {.bytes = std::string(line) + "\n"};
}

} // namespace splinefeed::host
