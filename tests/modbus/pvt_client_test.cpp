// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/pvt/pvt_client.hpp"

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

/// What the drive answers to functions 03 and 16 on TCP.
ScriptedPeer::Reply answer_of(PvtDrive& drive, const Bytes& request) {
    constexpr std::uint8_t write = 16;
    if (request[7] == write) {
        std::vector<std::uint16_t> registers(big_endian(request, 10));
        for (std::size_t i = 0; i < registers.size(); ++i) {
            registers[i] = static_cast<std::uint16_t>(big_endian(request, 13 + 2 * i));
        }
        const bool taken = drive.write(static_cast<int>(big_endian(request, 8)), registers) == ModbusException::none;
        return {tcp_reply(request, taken ? Bytes{1, write, request[8], request[9], request[10], request[11]}
                                         : Bytes{1, 0x90, 3}),
                false};
    }
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

TEST_CASE("Client: what nobody asked for stays in the drive as it was") {
    PvtDrive drive(PvtDriveParameters{});
    std::array<std::uint16_t, pvt::configuration_registers> registers{};
    encode(PvtConfiguration{.watchdog_ms = 77, .stop_reserve_ms = 150, .following_window = 500}, registers);
    REQUIRE(drive.write(pvt::configuration_address, registers) == ModbusException::none);
    const auto now = [&] {
        REQUIRE(drive.read(pvt::configuration_address, registers) == ModbusException::none);
        return decode_configuration(registers);
    };
    ScriptedPeer peer(ScriptedPeer::Wire::tcp, [&](const Bytes& request) { return answer_of(drive, request); });
    ModbusLink link(peer.address(), {.answer_us = 300'000});
    PvtClient client(link, 1);
    REQUIRE(client.open(1) == DriveProblem::none);
    REQUIRE(client.configure({.stop_reserve_ms = 100}) == DriveProblem::none);
    CHECK(now().stop_reserve_ms == 100);
    CHECK(now().watchdog_ms == 77);
    CHECK(now().following_window == 500);
    REQUIRE(client.configure({.watchdog_ms = 1000, .following_window = 0}) == DriveProblem::none);
    CHECK(now().stop_reserve_ms == 100);
    CHECK(now().watchdog_ms == 1000);
    CHECK(now().following_window == 0);
}
