// SPDX-License-Identifier: MIT
#include "host_sim/program/line_readings.hpp"

#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

TEST_CASE("The first line of each kind is told as each dialect reads it") {
    LineReadings readings;
    readings.add("G4 P2", "g4p2", 3);
    readings.add("G4 P9 ", "g4p9", 4);
    readings.add("T0101 \r", "t0101", 5);
    CHECK(readings.differences(Dialect::linuxcnc, std::array{Dialect::grbl}).empty());
    CHECK(readings.differences(Dialect::linuxcnc, std::array{Dialect::fanuc}) ==
          "'G4 P2' on line 3 waits 2 s, in fanuc it waits 0.002 s; "
          "'T0101' on line 5 is a number of a tool, in fanuc it is a lathe's tool and offset");
    CHECK(readings.differences(Dialect::fanuc, std::array{Dialect::marlin, Dialect::grbl}) ==
          "'G4 P2' on line 3 waits 0.002 s, in grbl it waits 2 s; 'T0101' on line 5 is a lathe's tool and offset, in "
          "marlin it is a number of a tool, in grbl it is a number of a tool");
}

TEST_CASE("A lathe's tool has four figures, and no others") {
    CHECK(has_lathe_tool("t0101"));
    CHECK(has_lathe_tool("n10t1212m8"));
    for (const char* const line : {"t1", "t01m6", "t010", "t01011", "g0x1", "m204p2000t2500", ""}) {
        CHECK(!has_lathe_tool(line));
    }
}
