// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/link/link_address.hpp"

#include "support/catch.hpp"

using namespace splinefeed::hal::modbus;

TEST_CASE("Link address: times on a serial line are those of its characters") {
    LinkAddress line{.wire = Wire::rtu, .host = "/dev/ttyUSB0", .baud = 9600};
    CHECK(frame_us(line, 8) == 9166); // 88 bits
    CHECK(silence_us(line) == 4010);  // 3.5 characters of 1145.8 us
    line.parity = 'N';
    CHECK(frame_us(line, 8) == 9166); // two stop bits by default
    line.stop_bits = 1;
    CHECK(frame_us(line, 8) == 8333); // 80 bits
    line.parity = 'E';
    CHECK(frame_us(line, 8) == 9166);
    line.baud = 115200;
    CHECK(silence_us(line) == 1750); // fixed above 19200
    // An exchange of a full block of a drive with one axis: 11 + 13 * 8 registers out, 22 in.
    CHECK(exchange_bytes(line, 115, 22).request == 243);
    CHECK(exchange_bytes(line, 115, 22).reply == 49);
    CHECK(exchange_us(line, 115, 22) == 27881 + 3500);
    CHECK(exchange_bytes(line, 0, 2).request == 8); // 01 03 32 00 00 02 and the CRC
    CHECK(exchange_bytes(line, 0, 2).reply == 9);
    CHECK(exchange_bytes(line, 2, 0).request == 13);
    CHECK(exchange_bytes(line, 2, 0).reply == 8);
    line.wire = Wire::tcp;
    CHECK(exchange_us(line, 115, 22) == 0);
    CHECK(silence_us(line) == 0);
}

TEST_CASE("Link address: units share a wire") {
    const LinkAddress one{.wire = Wire::rtu, .host = "/dev/ttyUSB0", .unit = 1};
    const LinkAddress two{.wire = Wire::rtu, .host = "/dev/ttyUSB0", .unit = 2};
    CHECK(one.same_wire(two));
    CHECK_FALSE(one == two);
    CHECK_FALSE(LinkAddress{.port = 502}.same_wire(LinkAddress{.port = 503}));
}
