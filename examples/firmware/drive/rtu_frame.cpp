// SPDX-License-Identifier: MIT
#include "drive/rtu_frame.hpp"

namespace firmware {

namespace {

using namespace rtu;
using splinefeed::hal::modbus::ModbusException;

constexpr std::size_t most_read = 125;
constexpr std::size_t most_written = 123;
constexpr std::size_t most_exchanged = 121; // written by function 23

/// Of the four bits that leave the register.
constexpr std::array<std::uint16_t, 16> crc_table = [] {
    std::array<std::uint16_t, 16> table{};
    for (unsigned i = 0; i < table.size(); ++i) {
        unsigned rest = i;
        for (int bit = 0; bit < 4; ++bit) {
            rest = (rest & 1U) != 0 ? 0xA001U ^ (rest >> 1U) : rest >> 1U;
        }
        table[i] = static_cast<std::uint16_t>(rest);
    }
    return table;
}();

std::uint16_t word_at(std::span<const std::uint8_t> bytes, std::size_t at) noexcept {
    return static_cast<std::uint16_t>(bytes[at] << 8U | bytes[at + 1]);
}

/// What a request asks for, and its answer as far as it is made.
struct Exchange {
    std::span<const std::uint8_t> request; // without CRC
    PvtRegisters& registers;
    RtuBytes& reply;
    std::size_t size = 0; // of the answer, without CRC

    ModbusException read(std::size_t at) noexcept {
        const std::size_t count = word_at(request, at + 2);
        if (count < 1 || count > most_read) {
            return ModbusException::illegal_value;
        }
        std::array<std::uint16_t, most_read> values{};
        const ModbusException exception = registers.read(word_at(request, at), std::span(values).first(count));
        reply[2] = static_cast<std::uint8_t>(2 * count);
        size = 3;
        for (const std::uint16_t value : std::span(values).first(count)) {
            reply[size++] = static_cast<std::uint8_t>(value >> 8U);
            reply[size++] = static_cast<std::uint8_t>(value & 0xFFU);
        }
        return exception;
    }

    /// The registers of the request that begin at `data`, to the address at `at`.
    ModbusException write(std::size_t at, std::size_t data, std::size_t count) noexcept {
        std::array<std::uint16_t, most_written> values{};
        for (std::size_t i = 0; i < count; ++i) {
            values[i] = word_at(request, data + 2 * i);
        }
        return registers.write(word_at(request, at), std::span<const std::uint16_t>(values).first(count));
    }
    ModbusException write_many(std::size_t at, std::size_t most) noexcept {
        const std::size_t count = word_at(request, at + 2);
        const std::size_t data = at + 5;
        if (count < 1 || count > most || request[data - 1] != 2 * count || request.size() != data + 2 * count) {
            return ModbusException::illegal_value;
        }
        return write(at, data, count);
    }
    void confirm() noexcept { // address and value, or number of registers
        for (size = 2; size < 6; ++size) {
            reply[size] = request[size];
        }
    }

    ModbusException execute() noexcept {
        const std::uint8_t function = request[1];
        const std::size_t head = head_size(function);
        if (head == 0) {
            return ModbusException::illegal_function;
        }
        if (request.size() < head || (!writes_many(function) && request.size() != head)) {
            return ModbusException::illegal_value;
        }
        ModbusException exception = ModbusException::none;
        switch (function) {
        case read_registers: return read(2);
        case write_register: exception = write(2, 4, 1); break;
        case write_registers: exception = write_many(2, most_written); break;
        default: // nothing is written if the read would be refused
            exception = read(2);
            exception = exception != ModbusException::none ? exception : write_many(6, most_exchanged);
            return exception != ModbusException::none ? exception : read(2);
        }
        confirm();
        return exception;
    }
};

} // namespace

std::uint16_t rtu_crc(std::span<const std::uint8_t> bytes) noexcept {
    unsigned rest = 0xFFFF;
    for (const std::uint8_t byte : bytes) {
        rest ^= byte;
        rest = rest >> 4U ^ crc_table[rest & 0xFU];
        rest = rest >> 4U ^ crc_table[rest & 0xFU];
    }
    return static_cast<std::uint16_t>(rest);
}

std::size_t answer_request(std::span<const std::uint8_t> request, std::uint8_t unit, PvtRegisters& registers,
                           RtuBytes& reply) noexcept {
    const bool to_all = !request.empty() && request[0] == rtu_broadcast;
    // The CRC of a frame with its own CRC is 0.
    if (request.size() < shortest || (request[0] != unit && !to_all) || rtu_crc(request) != 0) {
        return 0;
    }
    Exchange exchange{request.first(request.size() - crc_size), registers, reply};
    const ModbusException exception = exchange.execute();
    if (to_all) {
        return 0;
    }
    reply[0] = unit;
    reply[1] = request[1];
    std::size_t size = exchange.size;
    if (exception != ModbusException::none) {
        constexpr std::uint8_t refused = 0x80;
        reply[1] |= refused;
        reply[2] = static_cast<std::uint8_t>(exception);
        size = 3;
    }
    const std::uint16_t crc = rtu_crc(std::span(reply).first(size));
    reply[size] = static_cast<std::uint8_t>(crc & 0xFFU);
    reply[size + 1] = static_cast<std::uint8_t>(crc >> 8U);
    return size + crc_size;
}

} // namespace firmware
