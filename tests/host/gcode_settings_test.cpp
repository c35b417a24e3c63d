// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode_settings.hpp"

#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

TEST_CASE("Dialects and ignored words are read as they are typed") {
    CHECK(read_gcode_arguments({}).dialect == Dialect::linuxcnc);
    CHECK(read_gcode_arguments({}).ignored.empty());
    GcodeArguments typed;
    typed.dialect = "marlin";
    typed.ignore = "M104,e,g5.1,M";
    typed.block_delete = true;
    const GcodeSettings read = read_gcode_arguments(typed);
    CHECK(read.dialect == Dialect::marlin);
    CHECK(read.block_delete);
    CHECK_FALSE(read.optional_stop);
    REQUIRE(read.ignored.size() == 4);
    CHECK((read.ignored[0].letter == 'M' && read.ignored[0].tenths == 1040));
    CHECK((read.ignored[1].letter == 'E' && read.ignored[1].tenths == IgnoredWord::any));
    CHECK((read.ignored[2].letter == 'G' && read.ignored[2].tenths == 51));
    CHECK((read.ignored[3].letter == 'M' && read.ignored[3].tenths == IgnoredWord::any));
}

TEST_CASE("The first option of G-code that was given is known by its name") {
    GcodeArguments typed;
    CHECK(first_option(typed).empty());
    typed.optional_stop = true;
    CHECK(first_option(typed) == "--optional-stop");
    typed.dialect = "grbl";
    CHECK(first_option(typed) == "--dialect");
}

TEST_CASE("Lines and unknown words may be ignored, too") {
    GcodeArguments typed;
    typed.ignore = "start_print,$*,_x,E,unknown,LINE_*";
    const GcodeSettings read = read_gcode_arguments(typed);
    CHECK(read.ignored_lines == std::vector<std::string>{"START_PRINT", "$*", "_X", "LINE_*"});
    CHECK(read.ignored.size() == 1);
    CHECK(read.ignores_unknown);
}

TEST_CASE("The dialect may be guessed, and fanuc has increments") {
    GcodeArguments typed;
    typed.dialect = "auto";
    CHECK(read_gcode_arguments(typed).dialect_choice == DialectChoice::first_lines);
    CHECK(read_gcode_arguments(typed).dialect == Dialect::linuxcnc);
    typed.increments = true;
    typed.dialect = "fanuc";
    CHECK(read_gcode_arguments(typed).increments);
}
