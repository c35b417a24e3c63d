// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/pvt_drive/command_states.hpp"

#include "support/catch.hpp"
#include "support/places.hpp"

#include <cstdio>
#include <fstream>
#include <string>

using splinefeed::hal::modbus::fits;
using splinefeed::hal::modbus::PvtCommand;
using splinefeed::hal::modbus::PvtState;

TEST_CASE("command states: as the table of docs/reference/pvt_map.md has them", "[drive][command_states]") {
    std::ifstream document(splinefeed::test::source_folder() + "/docs/reference/pvt_map.md");
    REQUIRE(document);
    std::string line;
    while (std::getline(document, line) && line != "## Commands") {
    }
    int rows = 0;
    while (std::getline(document, line) && line.substr(0, 2) != "##") {
        int number = 0;
        if (std::sscanf(line.c_str(), "| %d ", &number) != 1) {
            continue;
        }
        CAPTURE(line);
        // The last column; what it says behind the states is not about them.
        const std::string column = line.substr(line.rfind('|', line.size() - 2) + 1);
        const std::string states = column.substr(0, column.find("the ring"));
        for (int state = 0; state <= 6; ++state) {
            const bool named = column.find("any") != std::string::npos ||
                               states.find(static_cast<char>('0' + state)) != std::string::npos;
            CAPTURE(state);
            CHECK(fits(static_cast<PvtCommand>(number), static_cast<PvtState>(state)) == named);
        }
        ++rows;
    }
    CHECK(rows == 11);
}
