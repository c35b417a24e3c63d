// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode_settings.hpp"

#include "refusal.hpp"
#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

std::string refusal(const GcodeArguments& arguments) {
    return refusal_of<UsageError>([&] { static_cast<void>(read_gcode_arguments(arguments)); });
}

} // namespace

TEST_CASE("Dialects and ignored words are read as they are typed") {
    CHECK(read_gcode_arguments({}).dialect == Dialect::linuxcnc);
    CHECK(read_gcode_arguments({}).ignored.empty());
    GcodeArguments typed;
    typed.dialect = "marlin";
    typed.ignore = "M104,e,g5.1";
    typed.block_delete = true;
    const GcodeSettings read = read_gcode_arguments(typed);
    CHECK(read.dialect == Dialect::marlin);
    CHECK(read.block_delete);
    CHECK_FALSE(read.optional_stop);
    REQUIRE(read.ignored.size() == 3);
    CHECK((read.ignored[0].letter == 'M' && read.ignored[0].tenths == 1040));
    CHECK((read.ignored[1].letter == 'E' && read.ignored[1].tenths == IgnoredWord::any));
    CHECK((read.ignored[2].letter == 'G' && read.ignored[2].tenths == 51));
}

TEST_CASE("Wrong dialects and words are refused with what is right") {
    GcodeArguments typed;
    typed.dialect = "mach3";
    CHECK(refusal(typed) == "--dialect 'mach3': it must be one of linuxcnc, grbl, marlin");
    for (const char* const wrong : {"", "104", "M", "M1x", "M104,", "G5.15", "M-1", "M99999"}) {
        typed = {};
        typed.ignore = wrong;
        if (std::string(wrong) == "M") {
            CHECK(refusal(typed) == "accepted"); // every M word
            continue;
        }
        CAPTURE(wrong);
        CHECK(refusal(typed).find("is no word; name words like M104,E, separated by commas") != std::string::npos);
    }
}

TEST_CASE("The first option of G-code that was given is known by its name") {
    GcodeArguments typed;
    CHECK(first_option(typed).empty());
    typed.optional_stop = true;
    CHECK(first_option(typed) == "--optional-stop");
    typed.dialect = "grbl";
    CHECK(first_option(typed) == "--dialect");
}
