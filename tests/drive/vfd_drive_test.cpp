// SPDX-License-Identifier: MIT
#include "host_sim/drive/vfd_drive.hpp"

#include "host_sim/config/shipped_profiles.hpp"
#include "support/catch.hpp"

#include <array>
#include <span>

using namespace splinefeed::hal::modbus;
using namespace splinefeed::host;

namespace {

ModbusException put(VfdDrive& drive, int address, std::uint16_t value) {
    return drive.write(address, std::span(&value, 1));
}

std::uint16_t get(VfdDrive& drive, int address) {
    std::array<std::uint16_t, 1> out{};
    REQUIRE(drive.read(address, out) == ModbusException::none);
    return out[0];
}

constexpr std::uint64_t second_us = 1'000'000;

} // namespace

TEST_CASE("A simulated inverter ramps to the speed that was written while it is told to run") {
    VfdDrive drive(find_profile("vfd-delta-ms300"), {.ramp_hz_s = 100.0});
    drive.advance(5 * second_us);                                // its clock begins anywhere
    REQUIRE(put(drive, 0x2001, 20000) == ModbusException::none); // 200 Hz
    drive.advance(6 * second_us);
    CHECK(get(drive, 0x2103) == 0);
    REQUIRE(put(drive, 0x2000, 0x12) == ModbusException::none);
    drive.advance(7 * second_us);
    CHECK(get(drive, 0x2103) == 10000);
    CHECK((get(drive, 0x2101) & 3) == 3);
    drive.advance(9 * second_us);
    CHECK(get(drive, 0x2103) == 20000);
    REQUIRE(put(drive, 0x2000, 0x22) == ModbusException::none); // through zero
    drive.advance(11 * second_us);
    CHECK(drive.output_hz() == Approx(0.0).margin(1e-9));
    drive.advance(12 * second_us);
    CHECK(drive.output_hz() == Approx(-100.0));
    CHECK(get(drive, 0x2103) == 10000);
    REQUIRE(put(drive, 0x2000, 0x01) == ModbusException::none);
    drive.advance(13 * second_us);
    CHECK(drive.output_hz() == 0.0);
    CHECK((get(drive, 0x2101) & 3) != 3);
}

TEST_CASE("A simulated inverter of coils turns by them, and reads its output from an input register") {
    VfdDrive drive(find_profile("vfd-h100"), {.ramp_hz_s = 100.0});
    const auto coil = [](int address) {
        return place_in(RegisterTable::coils, address);
    };
    const int output = place_in(RegisterTable::input, 0);
    drive.advance(0);
    REQUIRE(put(drive, 0x0201, 1000) == ModbusException::none); // 100 Hz
    REQUIRE(put(drive, coil(0x49), 1) == ModbusException::none);
    drive.advance(2 * second_us);
    CHECK(drive.output_hz() == 100.0);
    CHECK(get(drive, output) == 1000);
    REQUIRE(put(drive, coil(0x4B), 1) == ModbusException::none);
    CHECK(drive.direction() == 0);
    REQUIRE(put(drive, coil(0x4A), 1) == ModbusException::none); // though those of forward and stop still stand
    CHECK(drive.direction() == -1);
    REQUIRE(put(drive, coil(0x49), 0) == ModbusException::none); // is no command
    CHECK(drive.direction() == -1);
    CHECK(put(drive, coil(0x49), 2) == ModbusException::illegal_value);
    CHECK(put(drive, coil(0x48), 1) == ModbusException::illegal_address);
    CHECK(put(drive, output, 1) == ModbusException::illegal_address);
}

TEST_CASE("A simulated inverter reports that its speed is reached, and its fault, where the profile has that") {
    VfdDrive drive(find_profile("vfd-ls-ig5a"), {.ramp_hz_s = 100.0});
    drive.advance(0);
    REQUIRE(put(drive, 0x0005, 10000) == ModbusException::none);
    REQUIRE(put(drive, 0x0006, 0x0002) == ModbusException::none);
    drive.advance(second_us / 2);
    CHECK((get(drive, 0x000E) & 0x40) == 0);
    drive.advance(second_us);
    CHECK((get(drive, 0x000E) & 0x40) != 0);
    drive.trip();
    CHECK((get(drive, 0x000E) & 0x48) == 0x08);
    CHECK(put(drive, 0x0006, 0x0002) == ModbusException::none);
    CHECK(drive.direction() == 0); // not before it was switched off and on
    drive.power_cycle();
    CHECK((get(drive, 0x000E) & 0x08) == 0);
}
