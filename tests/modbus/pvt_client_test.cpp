// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/pvt_client.hpp"

#include "host_sim/drive/pvt_drive.hpp"
#include "scripted_peer.hpp"
#include "support/catch.hpp"

using namespace splinefeed::hal::modbus;
using namespace splinefeed_test;
using splinefeed::host::ModbusException;
using splinefeed::host::PvtDrive;
using splinefeed::host::PvtDriveParameters;

namespace {

unsigned big_endian(const Bytes& bytes, std::size_t at) {
    return static_cast<unsigned>(bytes[at] << 8U | bytes[at + 1]);
}

/// What the drive answers to function 03 on TCP.
ScriptedPeer::Reply answer_of(PvtDrive& drive, const Bytes& request) {
    std::vector<std::uint16_t> registers(big_endian(request, 10));
    if (drive.read(static_cast<int>(big_endian(request, 8)), registers) != ModbusException::none) {
        return {tcp_reply(request, {1, 0x83, 2}), false};
    }
    Bytes body{1, 3, static_cast<std::uint8_t>(2 * registers.size())};
    for (const std::uint16_t value : registers) {
        body.push_back(static_cast<std::uint8_t>(value >> 8U));
        body.push_back(static_cast<std::uint8_t>(value & 0xFFU));
    }
    return {tcp_reply(request, body), false};
}

} // namespace

TEST_CASE("Client: the clock of a probe behind one that failed is not taken: it may be a late answer's") {
    PvtDrive drive(PvtDriveParameters{});
    std::atomic<bool> silent{false};
    ScriptedPeer peer(ScriptedPeer::Wire::tcp, [&](const Bytes& request) {
        return silent.exchange(false) ? ScriptedPeer::Reply{} : answer_of(drive, request);
    });
    ModbusLink link(peer.address(), {.answer_us = 300'000});
    PvtClient client(link, 1);
    REQUIRE(client.open(1) == DriveProblem::none);
    CHECK_FALSE(client.report().clock.known());
    silent = true;
    REQUIRE_FALSE(client.probe().ok());
    REQUIRE(client.probe().ok());
    CHECK_FALSE(client.report().clock.known());
    REQUIRE(client.probe().ok());
    CHECK(client.report().clock.known());
}
