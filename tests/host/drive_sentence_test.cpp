// SPDX-License-Identifier: MIT
#include "host_sim/ports/modbus/drive_sentence.hpp"
#include "support/catch.hpp"

using namespace splinefeed::host;
using splinefeed::hal::Remedy;

TEST_CASE("A failure of a drive is said with its name, its place and the option that helps", "[drive_sentence]") {
    DriveTable table;
    table.drives.resize(2);
    table.drives[1].place = "m.toml:12: ";
    table.drives[1].name = "drive of y";
    CHECK(drive_sentence(table, {"it does not answer", 1}) == "m.toml:12: drive of y: it does not answer");
    CHECK(drive_sentence(table, {"it is in fault, code 7", 1, Remedy::reset}) ==
          "m.toml:12: drive of y: it is in fault, code 7; mend the cause, then run with --reset");
    CHECK(drive_sentence(table, {"it cannot home", 1, Remedy::omit_home}) ==
          "m.toml:12: drive of y: it cannot home, and omit --home");
}
