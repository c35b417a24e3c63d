// SPDX-License-Identifier: MIT
// docs/reference/gcode.md has each word of the code table with its dialects, and no other.
#include "splinefeed/s0_program/dialects/code_table.hpp"

#include "support/catch.hpp"
#include "support/places.hpp"

#include <array>
#include <cmath>
#include <fstream>
#include <set>
#include <string>
#include <utility>

using namespace splinefeed;

namespace {

using Word = std::pair<char, int>; // its letter, ten times its number

constexpr std::array<Dialect, 5> dialects{Dialect::linuxcnc, Dialect::grbl, Dialect::marlin, Dialect::fanuc,
                                          Dialect::klipper};
constexpr std::array<const char*, 5> names{"linuxcnc", "grbl", "marlin", "fanuc", "klipper"};

bool ends_with(const std::string& text, const std::string& end) {
    return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// The words in backticks of a cell; `A` to `B` is all between them, in tenths if one of both has a decimal.
std::set<Word> words_of(const std::string& cell) {
    std::set<Word> words;
    Word last{' ', 0};
    std::size_t end = 0;
    for (std::size_t at = cell.find('`'); at != std::string::npos; at = cell.find('`', end + 1)) {
        const bool range = cell.substr(end, at - end).find(" to ") != std::string::npos;
        const std::size_t begin = at + 1;
        end = cell.find('`', begin);
        const char letter = cell[begin];
        if (letter != 'G' && letter != 'M') { // S and T are no codes
            continue;
        }
        const Word word{letter,
                        static_cast<int>(std::lround(10.0 * std::stod(cell.substr(begin + 1, end - begin - 1))))};
        const int step = word.second % 10 == 0 && last.second % 10 == 0 ? 10 : 1;
        for (int code = range ? last.second : word.second; code <= word.second; code += step) {
            words.insert({letter, code});
        }
        last = word;
    }
    return words;
}

/// What the tables of the page say of one dialect.
struct Page {
    std::set<Word> taken;
    std::set<Word> refused;
};

Page page_of(const std::string& dialect) {
    std::ifstream document(splinefeed::test::source_folder() + "/docs/reference/gcode.md");
    REQUIRE(document);
    Page page;
    std::set<Word>* words = nullptr;
    for (std::string line; std::getline(document, line);) {
        if (line.substr(0, 7) == "| word ") {
            words = ends_with(line, "| refused in |") ? &page.refused
                    : ends_with(line, "| in |")       ? &page.taken
                                                      : nullptr;
            REQUIRE(words != nullptr);
        } else if (line.substr(0, 3) == "| `" && words != nullptr) {
            const std::string in = line.substr(line.rfind('|', line.size() - 2));
            if (in == "| all |" || in.find(dialect) != std::string::npos) {
                words->merge(words_of(line.substr(0, line.find('|', 1))));
            }
        } else if (line.empty()) {
            words = nullptr;
        }
    }
    return page;
}

} // namespace

TEST_CASE("the page of G-code has every word of the table, and no other", "[program][code_page]") {
    constexpr int most = 10000; // tenths
    for (unsigned i = 0; i < dialects.size(); ++i) {
        const Page page = page_of(names[i]);
        CHECK(page.taken.size() > 40);
        for (const char letter : {'G', 'M'}) {
            for (int code = 0; code <= most; code += letter == 'G' ? 1 : 10) {
                const CodeInfo info =
                    letter == 'G' ? find_g_code(code, dialects[i]) : find_m_code(code / 10, dialects[i]);
                const bool taken = info.group != CodeGroup::none && info.refusal == ProgramError::none;
                const bool refused = info.refusal != ProgramError::none && info.refusal != ProgramError::not_in_dialect;
                const Word word{letter, code};
                // A refused word stands for those with its whole number, too.
                const bool on_page = page.refused.count(word) > 0 || page.refused.count({letter, code / 10 * 10}) > 0;
                INFO(names[i] << ": " << letter << code / 10 << '.' << code % 10);
                if (taken != (page.taken.count(word) > 0)) {
                    FAIL_CHECK(
                        (taken ? "the page does not say that the dialect has it" : "the dialect does not have it"));
                }
                if (refused && !on_page) {
                    FAIL_CHECK("the page does not say that it is refused");
                }
                if (!refused && !taken && page.refused.count(word) > 0) {
                    FAIL_CHECK("it is unknown, not refused");
                }
            }
        }
    }
}
