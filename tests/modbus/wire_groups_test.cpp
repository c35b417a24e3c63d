// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/link/wire_groups.hpp"
#include "support/catch.hpp"

using namespace splinefeed::hal::modbus;

TEST_CASE("Wire groups: drives at one address share a wire, whatever their unit, and it is as slow as the slowest") {
    const LinkAddress bench{.host = "10.0.0.1", .unit = 1};
    const LinkAddress beside{.host = "10.0.0.1", .unit = 2};
    const LinkAddress other_port{.host = "10.0.0.1", .port = 1502};
    const LinkAddress serial{.wire = Wire::rtu, .host = "/dev/ttyUSB0"};
    const WireGroups groups = group_by_wire({{bench, {.answer_us = 10'000, .before_us = 7}},
                                             {serial, {.answer_us = 90'000}},
                                             {other_port, {.answer_us = 30'000}},
                                             {beside, {.answer_us = 70'000, .retries = 5}}},
                                            {.answer_us = 20'000, .before_us = 3, .retries = 2});
    CHECK(groups.of_drive == std::vector<std::size_t>{0, 1, 2, 0});
    REQUIRE(groups.wires.size() == 3);
    CHECK(groups.wires[0].link == bench);
    CHECK(groups.wires[0].timing.answer_us == 70'000);
    CHECK(groups.wires[0].timing.before_us == 7);
    CHECK(groups.wires[0].timing.retries == 5);
    CHECK(groups.wires[1].link == serial);
    CHECK(groups.wires[1].timing.answer_us == 90'000);
    CHECK(groups.wires[2].timing.answer_us == 30'000);
    CHECK(groups.wires[2].timing.before_us == 3);
}

TEST_CASE("Wire groups: no drives, no wires") {
    const WireGroups groups = group_by_wire({}, {});
    CHECK(groups.wires.empty());
    CHECK(groups.of_drive.empty());
}
