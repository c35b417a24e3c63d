// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/macro_word.hpp"

#include "support/catch.hpp"

using namespace splinefeed::host;

namespace {

FlowWord read(std::string_view line) {
    std::size_t wrong = 0;
    std::string_view right;
    const auto word = read_macro_word(line, wrong, right);
    CAPTURE(line, right);
    REQUIRE(has_macro_word(line));
    REQUIRE(word.has_value());
    return *word;
}

/// Where a statement is wrong, and what would be right.
std::string wrong(std::string_view line) {
    std::size_t at = 0;
    std::string_view right;
    CAPTURE(line);
    REQUIRE(has_macro_word(line));
    CHECK_FALSE(read_macro_word(line, at, right).has_value());
    return std::to_string(at) + ": " + std::string(right);
}

} // namespace

TEST_CASE("Statements in any case and spacing, behind / and an N number") {
    const FlowWord jump = read("/ n10 GoTo #1 (back)");
    CHECK((jump.kind == FlowKind::jump && jump.rest == 11 && jump.label_at == 6));
    const FlowWord branch = read("IF[[#1 EQ 1] AND [2]]GOTO30");
    CHECK((branch.kind == FlowKind::jump_if && branch.rest == 2 && branch.behind == 25));
    const FlowWord then = read("IF [#1 EQ #0] THEN #1=5");
    CHECK((then.kind == FlowKind::then && then.rest == 3 && then.behind == 19));
    const FlowWord loop = read("N20WHILE[#1LT5]DO2");
    CHECK((loop.kind == FlowKind::loop && loop.label == "DO2" && loop.rest == 8));
    const FlowWord endless = read("DO 1;");
    CHECK((endless.kind == FlowKind::loop && endless.label == "DO1" && endless.rest == 0));
    CHECK((read("END3").kind == FlowKind::end_loop && read("E N D 3").label == "DO3"));
    CHECK((read("N1 G65 P9010 A1").kind == FlowKind::call_macro && read("G065P1").rest == 4));
    CHECK((read("#3000=1 (STOP)").kind == FlowKind::alarm && read("#3006 = 1").rest == 8));
}

TEST_CASE("Other lines are no statements") {
    for (const char* line : {"", "G0 X1", "G650 P1", "G65.1 P1", "G66 P1", "#300=1", "#30000=1", "#3000", "#3001=0",
                             "(IF [1] GOTO 10)", "%", "N10", "M98 P1", "o1 if [1]", "D1", "I5 F3", "E5"}) {
        CAPTURE(line);
        CHECK_FALSE(has_macro_word(line));
    }
}

TEST_CASE("What is wrong in a statement is named") {
    CHECK(wrong("IF #1 EQ 2 GOTO 5") == "3: a condition stands in brackets, like [#1 LT 5]");
    CHECK(wrong("IF [1] GO 5") == "7: behind its condition IF has GOTO or THEN");
    CHECK(wrong("IF [1] THEN G0 X1").find("12: behind THEN a variable is set") == 0);
    CHECK(wrong("WHILE [1] #1=2").find("10: behind its condition WHILE has DO1") == 0);
    CHECK(wrong("DO4").find("3: DO and END have the number 1, 2 or 3") == 0);
    CHECK(wrong("END").find("DO and END have the number") != std::string::npos);
    CHECK(wrong("END1 G0 X1").find("5: DO and END") == 0);
    CHECK(wrong("GOTO 5 G0 X1").find("7: behind GOTO stands the number N") == 0);
    CHECK(wrong("IF [1] GOTO 5 X1").find("14: behind GOTO stands the number N") == 0);
}

TEST_CASE("The number of a block, the variables of arguments and comments") {
    CHECK((line_label("N10 G0 X1") == 10U && line_label("/N0007") == 7U && line_label(" n 1 2 x") == 12U));
    CHECK_FALSE((line_label("G0 N10") || line_label("N1.5") || line_label("N#1") || line_label("N1234567890")));
    const std::pair<char, int> table[] = {{'a', 1},  {'b', 2},  {'c', 3},  {'d', 7},  {'e', 8},  {'f', 9},  {'h', 11},
                                          {'i', 4},  {'j', 5},  {'k', 6},  {'m', 13}, {'q', 17}, {'r', 18}, {'s', 19},
                                          {'t', 20}, {'u', 21}, {'v', 22}, {'w', 23}, {'x', 24}, {'y', 25}, {'z', 26},
                                          {'g', 0},  {'l', 0},  {'n', 0},  {'o', 0},  {'p', 0},  {'?', 0},  {'#', 0}};
    for (const auto& [letter, number] : table) {
        CAPTURE(letter);
        CHECK(argument_number(letter) == number);
    }
    CHECK((comment_of("#3000=1 (A B) (c)") == "A B" && comment_of("#3000=1").empty() && comment_of("(open") == "open"));
}
