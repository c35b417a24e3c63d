// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/setpoint/stream_cost.hpp"

#include "host_sim/config/shipped_profiles.hpp"
#include "support/catch.hpp"

using namespace splinefeed::hal::modbus;
using splinefeed::host::find_profile;

namespace {

LinkAddress serial(int baud) {
    LinkAddress address;
    address.wire = Wire::rtu;
    address.baud = baud;
    return address;
}

} // namespace

TEST_CASE(
    "Stream cost: three Leadshine axes on one 115200-baud line take more than 9 ms, as their maker's table has it") {
    const DriveProfile profile = find_profile("leadshine-pr");
    const StreamCost fast = stream_cost(profile, serial(115200));
    // 25 and 8 bytes of 11 bits and two silences of 1.75 ms are 6.65 ms, more than the table's 3.08.
    CHECK(fast.target_us == 33U * 11U * 1000000U / 115200U + 3500U);
    CHECK(3 * fast.target_us >= 9000);
    CHECK(stream_cost(profile, serial(9600)).target_us ==
          33U * 11U * 1000000U / 9600U + 2U * (7U * 11U * 1000000U / 9600U / 2U));
    CHECK(fast.arrival_us == 25U * 11U * 1000000U / 115200U);
    DriveProfile slow = profile;
    slow.link.exchanges = {{9600, 90000}, {19200, 60000}};
    CHECK(stream_cost(slow, serial(38400)).target_us == 60000); // no exchange is shorter than the table has it
}

TEST_CASE("Stream cost: a drive that wants silences of 10 ms answers about 40 times a second") {
    DriveProfile profile = find_profile("cia402-kinco");
    profile.link.silence_before_us = 10000;
    profile.link.silence_after_us = 10000;
    profile.stream = StreamWay::cyclic; // a target alone: 13 and 8 bytes
    const StreamCost cost = stream_cost(profile, serial(115200));
    CHECK(cost.target_us == 23500U + 21U * 11U * 1000000U / 115200U);
    CHECK(1000000U / cost.target_us == 39);
    profile.stream = StreamWay::blocks; // and its speed before it
    CHECK(stream_cost(profile, serial(115200)).target_us == 2 * cost.target_us);
    CHECK(stream_cost(profile, serial(115200)).arrival_us == cost.target_us + cost.arrival_us);
    CHECK(cost.status_us > 2 * 20000); // two reads
    CHECK(cost.read_us > 20000);
    CHECK(cost.read_us < cost.status_us);
}

TEST_CASE("Stream cost: a tcp link counts its turnaround") {
    DriveProfile profile = find_profile("cia402-index");
    profile.link.turnaround_us = 300;
    const StreamCost cost = stream_cost(profile, LinkAddress{});
    CHECK(cost.target_us == 300);
    CHECK(cost.status_us == 600);
    CHECK(cost.arrival_us == 0);
}
