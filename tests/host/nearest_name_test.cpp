// SPDX-License-Identifier: MIT
#include "host_sim/base/nearest_name.hpp"

#include "host_sim/base/input_error.hpp"
#include "support/catch.hpp"

#include <array>
#include <vector>

using namespace splinefeed::host;

TEST_CASE("The nearest name is the one with the fewest edits") {
    constexpr std::array<std::string_view, 4> known{"x", "feed", "corner", "max_feed_mm_s"};
    CHECK(nearest_name("fed", known) == "feed");
    CHECK(nearest_name("FEED", known) == "feed");
    CHECK(nearest_name("efed", known) == "feed");
    CHECK(nearest_name("X", known) == "x");
    CHECK(nearest_name("q", known).empty());
    CHECK(nearest_name("", known).empty());
    CHECK(nearest_name("max_fed_mm_s", known) == "max_feed_mm_s");
    CHECK(nearest_name(std::string(1000, 'f'), known).empty());
    CHECK(suggestion("colour", known) == "; known are x, feed, corner, max_feed_mm_s");
    CHECK(suggestion("corners", known) == "; did you mean 'corner'?");
}

TEST_CASE("A name from another program is near to what means the same, if one alone does") {
    constexpr std::array<std::string_view, 4> known{"max_velocity_mm_s", "max_acceleration_mm_s2", "vfd-delta",
                                                    "vfd-yl620"};
    for (const char* name : {"max_velocity", "velocity", "speed", "seek", "vel", "MaxSpeed_mm_min"}) {
        CAPTURE(name);
        CHECK(meant_name(name, known) == (name[0] == 'M' ? "" : "max_velocity_mm_s"));
    }
    CHECK(meant_name("max_accel", known) == "max_acceleration_mm_s2");
    CHECK(meant_name("max_mm_s", known).empty());
    CHECK(meant_name("vfd", known).empty());
    const std::vector<std::string_view> many(13, "name");
    CHECK(suggestion("colour", many, "docs/reference/files.md") == "; docs/reference/files.md lists what is known");
}

TEST_CASE("A message stays on one line of the terminal") {
    CHECK(printable("a\nb\033[1m\x7f") == "a\\x0ab\\x1b[1m\\x7f");
    CHECK(printable("\xc3\xa4\xc2\x9b") == "\xc3\xa4\\x9b");
    CHECK(in_quotes(std::string(50, 'x')) == "'" + std::string(40, 'x') + "...'");
    CHECK(std::string(InputError("f", 3, "wrong").what()) == "f:3: wrong");
    CHECK(std::string(InputError("f", 0, "wrong").what()) == "f: wrong");
    CHECK(std::string(InputError("", 0, "wrong").what()) == "wrong");
}
