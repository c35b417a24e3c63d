// SPDX-License-Identifier: MIT
// RtuFrame: requests of Modbus RTU and their answers: functions 3, 6, 16 and 23 on holding registers.
// "MODBUS Application Protocol Specification V1.1b3", "MODBUS over Serial Line V1.02" (modbus.org).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace firmware {

class PvtRegisters;

inline constexpr std::uint8_t rtu_broadcast = 0;
using RtuBytes = std::array<std::uint8_t, 256>; ///< the longest frame

/// How many bytes a request has that begins like this, with its CRC; as many as are there, and more than their head, if
/// its function has no length of its own.
[[nodiscard]] std::size_t request_size(std::span<const std::uint8_t> begun) noexcept;

/// CRC-16 of Modbus; its low byte is sent first.
[[nodiscard]] std::uint16_t rtu_crc(std::span<const std::uint8_t> bytes) noexcept;

/// Executes a request to `unit`, or to all, and writes the answer with its CRC. Returns its size; 0: there is none,
/// because the CRC is wrong, because it is for another unit, or because it was to all.
[[nodiscard]] std::size_t answer_request(std::span<const std::uint8_t> request, std::uint8_t unit,
                                         PvtRegisters& registers, RtuBytes& reply) noexcept;

} // namespace firmware
