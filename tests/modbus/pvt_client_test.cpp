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

/// What the drive answers to functions 03, 16 and 23 on TCP.
ScriptedPeer::Reply answer_of(PvtDrive& drive, const Bytes& request) {
    constexpr std::uint8_t write = 16;
    constexpr std::uint8_t exchange = 23;
    const std::uint8_t function = request[7];
    const auto writes_from = [&](std::size_t at) { // address, count, bytes, values
        std::vector<std::uint16_t> registers(big_endian(request, at + 2));
        for (std::size_t i = 0; i < registers.size(); ++i) {
            registers[i] = static_cast<std::uint16_t>(big_endian(request, at + 5 + 2 * i));
        }
        return drive.write(static_cast<int>(big_endian(request, at)), registers) == ModbusException::none;
    };
    if (function == write) {
        return {tcp_reply(request, writes_from(8) ? Bytes{1, write, request[8], request[9], request[10], request[11]}
                                                  : Bytes{1, 0x90, 3}),
                false};
    }
    std::vector<std::uint16_t> registers(big_endian(request, 10));
    if ((function == exchange && !writes_from(12)) ||
        drive.read(static_cast<int>(big_endian(request, 8)), registers) != ModbusException::none) {
        return {tcp_reply(request, {1, static_cast<std::uint8_t>(function | 0x80U), 2}), false};
    }
    Bytes body{1, function, static_cast<std::uint8_t>(2 * registers.size())};
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
    auto&& [peer, link] = ScriptedLink(ScriptedPeer::Wire::tcp, {.answer_us = 300'000}, [&](const Bytes& request) {
        return silent.exchange(false) ? ScriptedPeer::Reply{} : answer_of(drive, request);
    });
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
    auto&& [peer, link] = ScriptedLink(ScriptedPeer::Wire::tcp, {.answer_us = 300'000},
                                       [&](const Bytes& request) { return answer_of(drive, request); });
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

TEST_CASE("Client: no bit that a frame on TCP changes on its way opens a session or reaches the configuration") {
    PvtDrive drive(PvtDriveParameters{});
    int address = 0;          // of the table
    unsigned spoiled_bit = 0; // of the first reading of it, or of the first writing
    bool spoils_write = false;
    bool spoils = false;
    ScriptedLink on(ScriptedPeer::Wire::tcp, {.answer_us = 300'000}, [&](const Bytes& request) {
        constexpr std::size_t first_written = 13;
        constexpr std::size_t first_read = 9;
        const bool hit =
            spoils && static_cast<int>(big_endian(request, 8)) == address && spoils_write == (request[7] == 16);
        const auto flip = [&](Bytes& bytes, std::size_t first) {
            std::uint8_t& byte = bytes[first + spoiled_bit / 8];
            byte = static_cast<std::uint8_t>(byte ^ 1U << spoiled_bit % 8);
            spoils = false;
        };
        Bytes arrived = request;
        if (hit && spoils_write) {
            flip(arrived, first_written);
        }
        ScriptedPeer::Reply reply = answer_of(drive, arrived);
        if (hit && !spoils_write) {
            flip(reply.bytes, first_read);
        }
        return reply;
    });
    const PvtSettings wanted{.stop_reserve_ms = 150, .watchdog_ms = 1000, .following_window = 500};
    const auto opens = [&] {
        PvtClient client(on.link, 1);
        REQUIRE(client.open(1) == DriveProblem::none);
        REQUIRE(client.configure(wanted) == DriveProblem::none);
        std::array<std::uint16_t, pvt::configuration_registers> registers{};
        REQUIRE(drive.read(pvt::configuration_address, registers) == ModbusException::none);
        const PvtConfiguration kept = decode_configuration(registers);
        CHECK(kept.stop_reserve_ms == wanted.stop_reserve_ms);
        CHECK(kept.watchdog_ms == wanted.watchdog_ms);
        CHECK(kept.following_window == wanted.following_window);
        CHECK_FALSE(spoils);
        CHECK(client.report().identity.boot == client.report().status.boot);
    };
    struct Table {
        int address;
        std::size_t registers;
        bool write;
    };
    for (const Table& table : {Table{pvt::identity_address, pvt::identity_registers, false},
                               Table{pvt::configuration_address, pvt::configuration_registers, false},
                               Table{pvt::configuration_address, pvt::configuration_registers, true}}) {
        address = table.address;
        spoils_write = table.write;
        for (spoiled_bit = 0; spoiled_bit < 16 * table.registers; ++spoiled_bit) {
            INFO("table " << address << (table.write ? " written" : " read") << ", bit " << spoiled_bit);
            spoils = true;
            opens();
        }
    }
}

TEST_CASE("Client: a line that spoils every other reading for a while costs no run") {
    PvtDrive drive(PvtDriveParameters{});
    int readings = 0;
    auto&& [peer, link] = ScriptedLink(ScriptedPeer::Wire::tcp, {.answer_us = 300'000}, [&](const Bytes& request) {
        ScriptedPeer::Reply reply = answer_of(drive, request);
        if (request[7] == 3 && ++readings <= 18) {
            reply.bytes.back() ^= static_cast<std::uint8_t>(readings % 2);
        }
        return reply;
    });
    PvtClient client(link, 1);
    CHECK(client.open(1) == DriveProblem::none);
    CHECK(readings >= 18);
}

TEST_CASE("Client: registers that are never twice the same, and a configuration that is not kept, are named") {
    PvtDrive drive(PvtDriveParameters{});
    bool changes = false;
    bool forgets = false;
    std::uint8_t count = 0;
    auto&& [peer, link] = ScriptedLink(ScriptedPeer::Wire::tcp, {.answer_us = 300'000}, [&](const Bytes& request) {
        Bytes arrived = request;
        if (forgets && request[7] == 16) {
            arrived[14] ^= 1U;
        }
        ScriptedPeer::Reply reply = answer_of(drive, arrived);
        if (changes) {
            reply.bytes.back() = ++count;
        }
        return reply;
    });
    PvtClient client(link, 1);
    REQUIRE(client.open(1) == DriveProblem::none);
    forgets = true;
    CHECK(client.configure({.watchdog_ms = 1000}) == DriveProblem::not_kept);
    changes = true;
    CHECK(client.open(1) == DriveProblem::damaged);
    CHECK(client.configure({.watchdog_ms = 1000}) == DriveProblem::damaged);
}

TEST_CASE("Client: a drive without a session refuses what only asks for its status, for as long as it is asked") {
    PvtDrive drive(PvtDriveParameters{});
    auto&& [peer, link] = ScriptedLink(ScriptedPeer::Wire::tcp, {.answer_us = 300'000},
                                       [&](const Bytes& request) { return answer_of(drive, request); });
    PvtClient client(link, 1);
    REQUIRE(client.open(1) == DriveProblem::none);
    for (int asked = 0; asked < 30;) { // more often than other refusals are taken before they are a problem
        asked += client.step() ? 1 : 0;
        link.clock().sleep_us(1000);
    }
    CHECK(client.report().status.refused == PvtRefusal::session);
    CHECK(client.report().problem == DriveProblem::none);
}
