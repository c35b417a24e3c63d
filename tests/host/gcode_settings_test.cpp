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
