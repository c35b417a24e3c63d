// SPDX-License-Identifier: MIT
// Instants of an exchange on a serial line: the link knows how long each frame is, and with it when a request arrived
// and when its answer began.
#include "scripted_peer.hpp"
#include "support/catch.hpp"

using namespace splinefeed::hal::modbus;
using namespace splinefeed_test;

TEST_CASE("Link: the instants of an exchange are those of its frames, for every function that has one value") {
    constexpr std::size_t repeated = 8; // unit, function, address, value, CRC
    constexpr std::size_t one_byte = 6; // unit, function, count, byte, CRC
    ScriptedLink on(ScriptedPeer::Wire::pty, {.answer_us = 300'000}, [](const Bytes& request) -> ScriptedPeer::Reply {
        constexpr std::uint8_t last_reading = 2;
        return {request[1] <= last_reading ? with_crc({request[0], request[1], 1, 1}) : request};
    });
    const auto check = [&](const LinkAnswer& answer, std::size_t reply) {
        REQUIRE(answer.ok());
        CHECK(answer.arrived_us - answer.sent_us == frame_us(on.peer.address(), repeated));
        CHECK(answer.answered_us - answer.replied_us == frame_us(on.peer.address(), reply));
    };
    bool bit = false;
    check(on.link.write_one(1, 5, 0xABCD), repeated);
    check(on.link.write_coil(1, 5, true), repeated);
    check(on.link.read_bit(1, BitTable::coils, 5, bit), one_byte);
    check(on.link.read_bit(1, BitTable::inputs, 5, bit), one_byte);
}
