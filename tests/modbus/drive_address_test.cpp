// SPDX-License-Identifier: MIT
#include "host_sim/config/drive_address.hpp"

#include "support/catch.hpp"

using namespace splinefeed::host;
using splinefeed::hal::modbus::Wire;

TEST_CASE("Target address: what the contract names") {
    const DriveAddress tcp = parse_drive_address("modbus-tcp://192.168.0.10:1502?profile=splinefeed-pvt&unit=3&axis=2");
    CHECK(tcp.link.wire == Wire::tcp);
    CHECK(tcp.link.host == "192.168.0.10");
    CHECK(tcp.link.port == 1502);
    CHECK(tcp.link.unit == 3);
    CHECK(tcp.axis == 2);
    CHECK(tcp.profile == "splinefeed-pvt");
    CHECK(tcp.resample);
    CHECK(parse_drive_address("modbus-tcp://drive").link.port == 502);
    const DriveAddress rtu = parse_drive_address("modbus-rtu:///dev/ttyUSB0?baud=19200&parity=N&unit=7&resample=no");
    CHECK(rtu.link.wire == Wire::rtu);
    CHECK(rtu.link.host == "/dev/ttyUSB0");
    CHECK(rtu.link.baud == 19200);
    CHECK(rtu.link.parity == 'N');
    CHECK(rtu.link.unit == 7);
    CHECK_FALSE(rtu.resample);
    CHECK(rtu.link.stops() == 2); // as the standard says
    CHECK(parse_drive_address("modbus-rtu:///dev/x?parity=N&stop=1").link.stops() == 1);
    CHECK(parse_drive_address("modbus-tcp://h?unit=255").link.unit == 255);
    CHECK(parse_drive_address("modbus-tcp://h?unit=247").link.unit == 247);
    CHECK_FALSE(tcp.following_window_counts.has_value());
    CHECK(parse_drive_address("modbus-tcp://h?following_window=0").following_window_counts == 0);
    CHECK(parse_drive_address("modbus-tcp://h?following_window=500").following_window_counts == 500);
}
