// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/short_line.hpp"

#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

constexpr std::size_t longest = 20;

std::string shortened(const std::string& line, bool open_comments = false) {
    ShortLine out;
    out.take(line, open_comments, longest);
    return std::string(out.text());
}

} // namespace

TEST_CASE("A line that is not too long stays as it is") {
    CHECK(shortened("G1 X5 (a) ; and more") == "G1 X5 (a) ; and more");
    CHECK(shortened("").empty());
}

TEST_CASE("A comment of any length is left out, and what it asks for stays") {
    const std::string text(300, 'x');
    CHECK(shortened("G1 (" + text + ") X5 (" + text + ")") == "G1 () X5 ()");
    CHECK(shortened("G1 X5 ;" + text) == "G1 X5 ");
    CHECK(shortened("(MSG, " + text + ") G1 X5 ; (" + text) == "(MSG, ) G1 X5 ");
    CHECK(shortened("(" + text + ";) X5") == "() X5");
    CHECK(shortened("(ABORT," + text + ")") == "(ABORT,)");
    CHECK(shortened("G1 X5 (" + text) == "G1 X5 ("); // still wrong
    CHECK(shortened("G1 X5 (" + text + "(a) X6").find("((") != std::string::npos);
    CHECK(shortened("G1 X5 (" + text, true) == "G1 X5 (");
    CHECK(shortened("G1 (" + text + "(a) X6", true) == "G1 () X6");
    CHECK(shortened("G1 X" + text) == "G1 X" + text); // too long without it, too
}

TEST_CASE("Places and texts are those of the line") {
    const std::string text(300, 'x');
    const std::string line = "(" + text + ") G1 (MSG,a " + text + "b) X5 (" + text + ") Y6";
    ShortLine taken;
    taken.take(line, false, longest);
    REQUIRE(taken.text() == "() G1 (MSG,) X5 () Y6");
    CHECK(taken.place(0) == 0);
    CHECK(line[taken.place(1)] == ')');
    CHECK(line.substr(taken.place(3), 2) == "G1");
    CHECK(line.substr(taken.place(13), 2) == "X5");
    CHECK(line.substr(taken.place(19), 2) == "Y6");
    CHECK(taken.comment(11) == "a " + text + "b");
    const std::string whole = "(MSG,a) X5";
    taken.take(whole, false, longest);
    CHECK(taken.place(8) == 8);
    CHECK(taken.comment(5) == "a");
}
