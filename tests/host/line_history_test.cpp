// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/line_history.hpp"

#include "support/catch.hpp"

using splinefeed::host::LineHistory;

TEST_CASE("The line of a move is known until the motion is past it") {
    LineHistory history;
    CHECK(history.line_of(0) == 0);
    for (const std::uint64_t line : {4U, 7U, 7U, 7U, 9U}) {
        history.add(line);
    }
    CHECK(history.moves() == 5);
    CHECK(history.line_of(0) == 4);
    CHECK(history.line_of(1) == 7);
    CHECK(history.line_of(3) == 7);
    CHECK(history.line_of(4) == 9);
    CHECK(history.line_of(5) == 0);
    history.forget_before(2);
    CHECK(history.line_of(0) == 0);
    CHECK(history.line_of(2) == 7);
    history.forget_before(100);
    CHECK(history.line_of(4) == 9); // where it stands
}

TEST_CASE("A history that nobody shortens keeps the last moves") {
    LineHistory history;
    for (std::uint64_t line = 1; line <= LineHistory::most + 10; ++line) {
        history.add(line);
    }
    CHECK(history.line_of(9) == 0);
    CHECK(history.line_of(10) == 11);
    CHECK(history.line_of(LineHistory::most + 9) == LineHistory::most + 10);
}
