// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/words/program_comment.hpp"

#include "support/gcode.hpp"

using namespace splinefeed_test;

namespace {

ProgramComment read(std::string_view line) {
    TextCursor text(line);
    ProgramComment out;
    CHECK(read_comment(text, false, out).ok());
    CHECK(text.at_end());
    return out;
}

} // namespace

TEST_CASE("what asks for something is a closed list of comments", "[program][comment]") {
    const std::string_view line = "( P r int , a text )";
    CHECK(read(line).kind == CommentKind::print);
    CHECK(read(line).text.of(line) == "a text ");
    CHECK(read("(MSG,a)").kind == CommentKind::message);
    CHECK(read("(debug,a)").kind == CommentKind::debug);
    for (const char* const text : {"()", "(MSG)", "(MSGA,b)", "(LOG,a)", "(LOGOPEN,a)", "(LOGAPPEND,a)", "(LOGCLOSE)",
                                   "(PROBEOPEN a)", "(PROBECLOSE)", "(ABORT)", "(aborted, once)", "(G0 X1)"}) {
        CAPTURE(text);
        CHECK(read(text).kind == CommentKind::none);
    }
}

TEST_CASE("ABORT ends the program in the place of the other words of its line", "[program][comment]") {
    GcodeRun<double> run;
    const BlockStatus status = run.push("G0 X5 ( ABORT, no probe )");
    CHECK(status.error == ProgramError::program_aborted);
    CHECK(status.column == 16);
    CHECK(run.items().empty());
    CHECK(run.interpreter().position()[0].raw == 0);
}
