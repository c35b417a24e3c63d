// SPDX-License-Identifier: MIT
#include "host_sim/drive/register_file.hpp"

#include "support/catch.hpp"

#include <array>

using namespace splinefeed::hal::modbus;
using namespace splinefeed::host;

namespace {

RegisterField field(std::uint16_t address, std::uint8_t width, FieldAccess access, std::int64_t highest = 0x7FFFFFFF) {
    RegisterField out;
    out.name = std::to_string(address);
    out.address = address;
    out.width_bits = width;
    out.access = access;
    out.highest = highest;
    return out;
}

using Registers = std::array<std::uint16_t, 4>;

} // namespace

TEST_CASE("Register file: numbers are read and written whole, and unknown registers are not there") {
    DriveProfile profile;
    profile.fields = {field(10, 16, FieldAccess::read_write, 100), field(11, 32, FieldAccess::read_write),
                      field(14, 16, FieldAccess::read)};
    RegisterFile file(profile);
    Registers registers{7, 1, 2, 0};
    CHECK(file.write(10, std::span(registers).first(3)) == ModbusException::none);
    CHECK(file.raw(0) == 7);
    CHECK(file.raw(1) == 0x10002);
    CHECK(file.was_written(1));
    CHECK_FALSE(file.was_written(2));
    CHECK(file.write(10, std::span(registers).first(2)) == ModbusException::illegal_address); // half of 11
    CHECK(file.write(12, std::span(registers).first(1)) == ModbusException::illegal_address);
    CHECK(file.write(10, std::span(registers).first(4)) == ModbusException::illegal_address); // 13 is nobody's
    CHECK(file.write(14, std::span(registers).first(1)) == ModbusException::illegal_address); // read only
    CHECK(file.write(9, std::span(registers).first(2)) == ModbusException::illegal_address);
    CHECK(file.write(10, std::span(registers).first(0)) == ModbusException::illegal_address);
    registers = {101, 0, 5, 0};
    CHECK(file.write(10, std::span(registers).first(3)) == ModbusException::illegal_value);
    CHECK(file.raw(1) == 0x10002); // all or none
    file.set(2, 42);
    std::array<std::uint16_t, 5> read{};
    CHECK(file.read(10, read) == ModbusException::none);
    CHECK(read == std::array<std::uint16_t, 5>{7, 1, 2, 0, 42});
    CHECK(file.read(12, std::span(read).first(1)) == ModbusException::illegal_address);
    CHECK(file.read(13, std::span(read).first(1)) == ModbusException::illegal_address);
    CHECK(file.read(65534, std::span(read).first(3)) == ModbusException::illegal_address);
}

TEST_CASE("Register file: each table has addresses of its own, and no frame reaches into the next one") {
    DriveProfile profile;
    profile.fields = {field(65535, 16, FieldAccess::read_write, 100), field(0, 16, FieldAccess::read),
                      field(0, 1, FieldAccess::read_write, 1)};
    profile.fields[1].table = RegisterTable::input;
    profile.fields[2].table = RegisterTable::coils;
    RegisterFile file(profile);
    file.set(1, 7);
    Registers registers{1, 0, 0, 0};
    const int input = place_in(RegisterTable::input, 0);
    const int coil = place_in(RegisterTable::coils, 0);
    CHECK(file.write(coil, std::span(registers).first(1)) == ModbusException::none);
    CHECK(file.raw(2) == 1);
    CHECK(file.was_written(2));
    CHECK_FALSE(file.was_written(0));
    CHECK(file.write(input, std::span(registers).first(1)) == ModbusException::illegal_address);
    CHECK(file.read(input, std::span(registers).first(1)) == ModbusException::none);
    CHECK(registers[0] == 7);
    CHECK(file.read(65535, std::span(registers).first(1)) == ModbusException::none);
    CHECK(file.read(65535, std::span(registers).first(2)) == ModbusException::illegal_address);
    CHECK(file.read(place_in(RegisterTable::discrete, 0), std::span(registers).first(1)) ==
          ModbusException::illegal_function);
}

TEST_CASE("Register file: two images at one address, reset, and words that swap") {
    DriveProfile profile;
    profile.fields = {field(0, 32, FieldAccess::read), field(0, 32, FieldAccess::write)};
    profile.fields[1].value = 9;
    RegisterFile file(profile);
    CHECK(file.raw(1) == 9);
    Registers registers{0, 5, 0, 0};
    CHECK(file.write(0, std::span(registers).first(2)) == ModbusException::none);
    file.set(0, 0x20003);
    CHECK(file.raw(1) == 5);
    CHECK(file.read(0, std::span(registers).first(2)) == ModbusException::none);
    CHECK(registers[0] == 2);
    file.swap_words();
    CHECK(file.raw(1) == 5);
    CHECK(file.read(0, std::span(registers).first(2)) == ModbusException::none);
    CHECK(registers[0] == 3);
    file.swap_words();
    CHECK(file.raw(0) == 0x20003);
    file.reset();
    CHECK(file.raw(0) == 0);
    CHECK(file.raw(1) == 9);
}
