// SPDX-License-Identifier: MIT
#include "host_sim/program/left_out_list.hpp"

#include "support/catch.hpp"

using namespace splinefeed::host;

TEST_CASE("What is left out is counted by word, with its first line") {
    LeftOutList list;
    list.at_line(3);
    list.add("M104");
    list.add("e0.5");
    list.at_line(7);
    list.add("m 1 04");
    list.add("E1");
    list.add_line("START_PRINT");
    const auto entries = list.entries();
    REQUIRE(entries.size() == 3);
    CHECK((entries[0].what == "M104" && entries[0].count == 2 && entries[0].line == 3));
    CHECK((entries[1].what == "E" && entries[1].count == 2 && entries[1].line == 3));
    CHECK((entries[2].what == "START_PRINT" && entries[2].count == 1 && entries[2].line == 7));
    list.begin();
    CHECK(list.entries().empty());
}
