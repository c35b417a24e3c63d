// SPDX-License-Identifier: MIT
// PvtRegisters: the tables of the map splinefeed-pvt (docs/reference/pvt_map.md) before a drive: reads of identity,
// configuration and status, writes of configuration and exchange block.
#pragma once

#include "drive/pvt_drive.hpp"

namespace firmware {

enum class ModbusException : std::uint8_t { none, illegal_function, illegal_address, illegal_value };

class PvtRegisters {
public:
    PvtRegisters(PvtDrive& drive, std::uint32_t boot_number) noexcept : drive_(drive), boot_(boot_number) {}

    /// All of them, or none and an exception.
    [[nodiscard]] ModbusException read(unsigned address, std::span<std::uint16_t> out) noexcept;
    [[nodiscard]] ModbusException write(unsigned address, std::span<const std::uint16_t> values) noexcept;

private:
    using Block = splinefeed::hal::modbus::PvtBlock;

    void encode_status(std::span<std::uint16_t> out) const noexcept;
    [[nodiscard]] ModbusException write_configuration(std::size_t at, std::span<const std::uint16_t> values) noexcept;
    [[nodiscard]] ModbusException write_block(std::span<const std::uint16_t> registers) noexcept;
    [[nodiscard]] PvtRefusal take(const Block& block, std::span<const PvtSegment> segments) noexcept;
    [[nodiscard]] PvtRefusal command(const Block& block, std::span<const PvtSegment> segments) noexcept;

    PvtDrive& drive_;
    std::uint32_t boot_;
    splinefeed::hal::modbus::PvtSegments segments_{}; // of the block that is decoded
    std::uint16_t nonce_ = 0;
    std::uint16_t last_command_ = 0;
    std::uint16_t refusals_ = 0;
    PvtRefusal refused_ = PvtRefusal::none;
};

} // namespace firmware
