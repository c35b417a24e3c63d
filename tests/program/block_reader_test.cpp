// SPDX-License-Identifier: MIT
#include "support/gcode.hpp"

using namespace splinefeed_test;

namespace {

/// "error column length" of a line.
std::string refused(const std::string& line, ProgramSettings settings = six_axes(),
                    const std::string& before = "F100") {
    GcodeRun<double> run(settings);
    run.run(before);
    const BlockStatus status = run.push(line);
    return std::string(describe(status.error)) + " " + std::to_string(status.column) + " " +
           std::to_string(status.length);
}

std::string said(ProgramError error, int column, int length) {
    return std::string(describe(error)) + " " + std::to_string(column) + " " + std::to_string(length);
}

} // namespace

TEST_CASE("words in any case and spacing, with comments", "[program][reader]") {
    for (const char* const line :
         {"G1X1.5Y-2Z.5", "g 1 x 1 . 5 y - 2 z . 5", "N10 G01 Z0.5 Y-2 X1.5",
          "\tG1 X1.5 (a comment) Y-2 Z+0.5 ; and more", "G1 X1.5 Y-2 Z.5\r\n", "X[3/2] G1 (Y7) Y-[1+1] Zsin[30]",
          "/G1 X1.5 Y-2 Z.5", "N99999999 G1 X1.5 Y-2 Z.5"}) {
        GcodeRun<double> run;
        run.run("F100");
        CAPTURE(line);
        CHECK(run.last(line) == "feed 1.5 -2 0.5");
    }
}

TEST_CASE("lines that hold no motion", "[program][reader]") {
    GcodeRun<double> run;
    CHECK(run.text("\n   \n(only a comment)\n; G0 X1\nN100\n()") == "");
}

TEST_CASE("messages", "[program][reader]") {
    GcodeRun<double> run;
    CHECK(run.text("( m s g , Now turn it) G0 X1") == "event 0 0 0 Now turn it\nrapid 1 0 0");
    CHECK(run.text("(print,#1 is one)") == "event 1 0 0 #1 is one");
    CHECK(run.text("(DEBUG,x)") == "event 2 0 0 x");
    CHECK(run.text("(message, not one)") == "");
}

TEST_CASE("% begins and ends a program", "[program][reader]") {
    GcodeRun<double> run;
    CHECK(run.text("%\nG0 X1\n%\nG0 X500") ==
          "rapid 1 0 0\nevent " + std::to_string(static_cast<int>(EventKind::program_end)) + " stop 0 0");
    CHECK(run.interpreter().has_ended());
    run.interpreter().restart();
    CHECK(run.text("G0 X2\nM2\nX3") ==
          "rapid 2 0 0\nevent " + std::to_string(static_cast<int>(EventKind::program_end)) + " stop 2 0");
}

TEST_CASE("block delete", "[program][reader]") {
    ProgramSettings settings = six_axes();
    settings.block_delete = true;
    GcodeRun<double> run(settings);
    CHECK(run.text("/G0 X1\nG0 Y1\n / X9") == "rapid 0 1 0");
}

TEST_CASE("wrong text is refused at its place", "[program][reader]") {
    CHECK(refused("G1 X") == said(ProgramError::number_invalid, 4, 1));
    CHECK(refused("G1 X1 ?") == said(ProgramError::character_invalid, 7, 1));
    CHECK(refused(std::string("G1 X1") + '\0' + "Y2") == said(ProgramError::character_invalid, 6, 1));
    CHECK(refused("G\xc3\xa4 X1") == said(ProgramError::number_invalid, 1, 1));
    CHECK(refused("G1 X1 (open") == said(ProgramError::comment_not_closed, 7, 1));
    CHECK(refused("G1 (a (b) X1") == said(ProgramError::comment_nested, 7, 1));
    CHECK(refused("G1 X1 X2") == said(ProgramError::word_repeated, 7, 2));
    CHECK(refused("G1 X1 G2") == said(ProgramError::modal_group_conflict, 7, 2));
    CHECK(refused("M7 M8") == said(ProgramError::modal_group_conflict, 4, 2));
    CHECK(refused("G1.5 X1") == said(ProgramError::g_code_unknown, 1, 4));
    CHECK(refused("G-1 X1") == said(ProgramError::g_code_unknown, 1, 1));
    CHECK(refused("G1000000 X1") == said(ProgramError::g_code_unknown, 1, 8));
    CHECK(refused("M12") == said(ProgramError::m_code_unknown, 1, 3));
    CHECK(refused("X1 G43.2 H3") == said(ProgramError::tool_offset_sum_unsupported, 4, 5));
    CHECK(refused("G1 X1e3") == said(ProgramError::number_has_exponent, 4, 2));
    CHECK(refused(std::string("G1 X").append(300, '1')) == said(ProgramError::line_too_long, 257, 1));
    CHECK(refused(std::string("G1 X").append(200, '1')) == said(ProgramError::number_out_of_range, 4, 201));
    ProgramSettings grbl = six_axes();
    grbl.dialect = Dialect::grbl;
    CHECK(refused("G1 @3 ^45", grbl) == said(ProgramError::polar_unsupported, 4, 2));
    CHECK(refused("G1 @3 @45") == said(ProgramError::word_repeated, 7, 3));
    CHECK(refused("G1 @ ^45") == said(ProgramError::number_invalid, 4, 1));
    CHECK(refused("o100 sub") == said(ProgramError::o_word, 1, 4));
    CHECK(refused("G1 X1 % 2") == said(ProgramError::character_invalid, 7, 1));
    CHECK(refused("% 2", six_axes(), "G0") == said(ProgramError::character_invalid, 3, 1));
}

TEST_CASE("without an evaluator expressions are refused", "[program][reader]") {
    Interpreter<double> interpreter(six_axes());
    interpreter.start({});
    CHECK(interpreter.push("G0 X#1", 1).error == ProgramError::expression_unsupported);
    CHECK(interpreter.push("G0 X[1]", 1).error == ProgramError::expression_unsupported);
    CHECK(interpreter.push("#1=2", 1).error == ProgramError::expression_unsupported);
    CHECK(interpreter.push("G0 Xsin[1]", 1).error == ProgramError::number_invalid);
    CHECK(interpreter.push("G0 X1", 1).ok());
}

TEST_CASE("the items of a block must be taken before the next", "[program][reader]") {
    Interpreter<double> interpreter(six_axes());
    interpreter.start({});
    REQUIRE(interpreter.push("G0 X1", 1).ok());
    CHECK(interpreter.push("G0 X2", 2).error == ProgramError::block_pending);
    ProgramItem<double> item;
    CHECK(interpreter.next(item) == Pull::item);
    CHECK(interpreter.next(item) == Pull::starved);
    CHECK(interpreter.push("G0 X2", 2).ok());
}

TEST_CASE("words that may be ignored", "[program][reader]") {
    const IgnoredWord ignored[] = {{'M', 1040}, {'M', 8623}, {'E', IgnoredWord::any}, {'G', 290}};
    ProgramSettings settings = six_axes();
    settings.dialect = Dialect::marlin;
    settings.ignored = ignored;
    settings.ignored_count = 4;
    GcodeRun<double> run(settings);
    CHECK(run.text("M104 S200 T0\nM862.3 P \"MK3S\" ; who\nG29\nG1 X1 E5 F600") == "feed 1 0 0");
    CHECK(run.text("G1 X2 M104").empty() == false);
    CHECK(run.push("G1 X\"1\"").error == ProgramError::number_invalid);
}
