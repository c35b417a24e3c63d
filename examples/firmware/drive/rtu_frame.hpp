// SPDX-License-Identifier: MIT
// RtuFrame: requests of Modbus RTU and their answers: functions 3, 6, 16 and 23 on holding registers.
// "MODBUS Application Protocol Specification V1.1b3", "MODBUS over Serial Line V1.02" (modbus.org).
#pragma once

#include "drive/pvt_drive.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace firmware {

inline constexpr std::uint8_t rtu_broadcast = 0;
using RtuBytes = std::array<std::uint8_t, 256>; ///< the longest frame

namespace rtu {

enum Function : std::uint8_t { read_registers = 3, write_register = 6, write_registers = 16, write_and_read = 23 };

inline constexpr std::size_t crc_size = 2;
inline constexpr std::size_t shortest = 2 + crc_size; // unit, function

/// Up to the registers that a request writes, with the count of their bytes; the whole without CRC if it writes none.
[[nodiscard]] constexpr std::size_t head_size(std::uint8_t function) noexcept {
    switch (function) {
    case read_registers:
    case write_register: return 6;
    case write_registers: return 7;
    case write_and_read: return 11;
    default: return 0;
    }
}

[[nodiscard]] constexpr bool writes_many(std::uint8_t function) noexcept {
    return function == write_registers || function == write_and_read;
}

} // namespace rtu

/// How many bytes a request has that begins like this, with its CRC; as many as are there, and more than their head, if
/// its function has no length of its own. Defined here: the interrupt asks.
[[nodiscard]] constexpr std::size_t request_size(std::span<const std::uint8_t> begun) noexcept {
    if (begun.size() < rtu::shortest) {
        return rtu::shortest;
    }
    const std::size_t head = rtu::head_size(begun[1]);
    if (begun.size() < head || head == 0) {
        return head != 0 ? head + rtu::crc_size : begun.size();
    }
    return head + rtu::crc_size + (rtu::writes_many(begun[1]) ? begun[head - 1] : 0U);
}

/// CRC-16 of Modbus; its low byte is sent first.
[[nodiscard]] std::uint16_t rtu_crc(std::span<const std::uint8_t> bytes) noexcept;

/// Executes a request to `unit`, or to all, and writes the answer with its CRC. Returns its size; 0: there is none,
/// because the CRC is wrong, because it is for another unit, or because it was to all.
[[nodiscard]] std::size_t answer_request(std::span<const std::uint8_t> request, std::uint8_t unit,
                                         PvtRegisters& registers, RtuBytes& reply) noexcept;

} // namespace firmware
