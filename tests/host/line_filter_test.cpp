// SPDX-License-Identifier: MIT
#include "host_sim/program/line_filter.hpp"

#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

TEST_CASE("A macro is a name that no word begins with") {
    CHECK(macro_name("START_PRINT BED=60") == "START_PRINT");
    CHECK(macro_name("  _home") == "_home");
    CHECK(macro_name("END") == "END");
    CHECK(macro_name("SET_PIN;x") == "SET_PIN");
    for (const char* const word : {"G1 X5", "X SIN[30]", "XSIN[30]", "M104", "", "  ", "(A B)", "; AB", "o100 sub",
                                   "o<ab> call", "G", "X", "T?", "#<ab>=1", "G28 X", "N10 G1"}) {
        CAPTURE(word);
        CHECK(macro_name(word).empty());
    }
}

TEST_CASE("Lines are left out by their first word") {
    GcodeSettings settings;
    CHECK(left_out_line("$X", settings).empty());
    settings.ignored_lines = {"START_PRINT", "$*", "LINE_*"};
    CHECK(left_out_line("start_print T=200", settings) == "start_print");
    CHECK(left_out_line("START_PRINT_NOW", settings).empty());
    CHECK(left_out_line(" $32=1 ; laser", settings) == "$32=1");
    CHECK(left_out_line("LINE_PURGE", settings) == "LINE_PURGE");
    CHECK(left_out_line("G1 X5", settings).empty());
}

TEST_CASE("Unknown lines are left out where that is told") {
    GcodeSettings settings;
    settings.ignores_unknown = true;
    for (const char* const line : {"$X", "START_PRINT", "?", "!", "~", "hello world"}) {
        CAPTURE(line);
        CHECK_FALSE(left_out_line(line, settings).empty());
    }
    for (const char* const line : {"G1 X5", "%", "(a b)", "", "#1=2", "o1 sub", "/G1 X2"}) {
        CAPTURE(line);
        CHECK(left_out_line(line, settings).empty());
    }
    settings.dialect = Dialect::grbl;
    CHECK(left_out_line("$H", settings).empty());
    CHECK(left_out_line("$HX", settings) == "$HX");
}

TEST_CASE("Klipper's commands that move nothing are left out") {
    GcodeSettings settings;
    settings.dialect = Dialect::klipper;
    CHECK(left_out_line("EXCLUDE_OBJECT_START NAME=a", settings) == "EXCLUDE_OBJECT_START");
    CHECK(left_out_line("set_velocity_limit accel=1", settings) == "set_velocity_limit");
    CHECK(left_out_line("SET_GCODE_OFFSET Z=1", settings).empty()); // it moves
    settings.dialect = Dialect::marlin;
    CHECK(left_out_line("EXCLUDE_OBJECT_START NAME=a", settings).empty());
}
