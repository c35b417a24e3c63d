// SPDX-License-Identifier: MIT
#include "host_sim/config/target_address.hpp"

#include "support/catch.hpp"

using namespace splinefeed::host;
using splinefeed::hal::modbus::Wire;

TEST_CASE("Target address: what the contract names") {
    const TargetAddress tcp =
        parse_target_address("modbus-tcp://192.168.0.10:1502?profile=splinefeed-pvt&unit=3&axis=2");
    CHECK(tcp.link.wire == Wire::tcp);
    CHECK(tcp.link.host == "192.168.0.10");
    CHECK(tcp.link.port == 1502);
    CHECK(tcp.link.unit == 3);
    CHECK(tcp.axis == 2);
    CHECK(tcp.profile == "splinefeed-pvt");
    CHECK(tcp.resample);
    CHECK(parse_target_address("modbus-tcp://drive").link.port == 502);
    const TargetAddress rtu = parse_target_address("modbus-rtu:///dev/ttyUSB0?baud=19200&parity=N&unit=7&resample=no");
    CHECK(rtu.link.wire == Wire::rtu);
    CHECK(rtu.link.host == "/dev/ttyUSB0");
    CHECK(rtu.link.baud == 19200);
    CHECK(rtu.link.parity == 'N');
    CHECK(rtu.link.unit == 7);
    CHECK_FALSE(rtu.resample);
    CHECK(rtu.link.stops() == 2); // as the standard says
    CHECK(parse_target_address("modbus-rtu:///dev/x?parity=N&stop=1").link.stops() == 1);
    CHECK(parse_target_address("modbus-tcp://h?unit=255").link.unit == 255);
    CHECK(parse_target_address("modbus-tcp://h?unit=247").link.unit == 247);
    CHECK_FALSE(tcp.following_window_counts.has_value());
    CHECK(parse_target_address("modbus-tcp://h?following_window=0").following_window_counts == 0);
    CHECK(parse_target_address("modbus-tcp://h?following_window=500").following_window_counts == 500);
}

TEST_CASE("Target address: what is wrong is told, and what would be right") {
    const std::pair<const char*, const char*> cases[] = {
        {"modbus://x", "write modbus-tcp://HOST:PORT"},
        {"modbus-tcp://", "there is no host"},
        {"modbus-rtu://", "there is no device"},
        {"modbus-tcp://h:0", "port is '0'; it must be a whole number from 1 to 65535"},
        {"modbus-tcp://h:1:2", "more than one ':'"},
        {"modbus-tcp://h?unit=0",
         "unit is '0'; it must be a whole number from 1 to 247, or 255, the device at that address itself"},
        {"modbus-tcp://h?unit=250", "unit is '250'; it must be a whole number from 1 to 247, or 255"},
        {"modbus-tcp://h?unit=256", "from 1 to 247, or 255"},
        {"modbus-rtu:///dev/x?unit=255", "unit is '255'; it must be a whole number from 1 to 247"},
        {"modbus-tcp://h?stop=1", "unknown key 'stop'"},
        {"modbus-rtu:///dev/x?stop=3", "from 1 to 2"},
        {"modbus-tcp://h?following_window=-1", "from 0 to 2147483647"},
        {"modbus-rtu:///dev/x?unit=248", "from 1 to 247"},
        {"modbus-tcp://h?baud=9600", "unknown key 'baud'"},
        {"modbus-tcp://h?untt=1", "did you mean 'unit'?"},
        {"modbus-rtu:///dev/x?baud=9601", "it must be one of 1200"},
        {"modbus-rtu:///dev/x?parity=X", "it must be N, E or O"},
        {"modbus-tcp://h?axis=6", "from 0 to 5"},
        {"modbus-tcp://h?resample=maybe", "it must be yes or no"},
        {"modbus-tcp://h?unit", "has no value"},
        {"modbus-tcp://h?unit=", "has no value"},
    };
    for (const auto& [text, expected] : cases) {
        INFO(text);
        try {
            static_cast<void>(parse_target_address(text));
            FAIL("it was taken");
        } catch (const AddressError& error) {
            INFO(error.what());
            CHECK(std::string(error.what()).find(expected) != std::string::npos);
        }
    }
}
