// SPDX-License-Identifier: MIT
// RegisterFile: the registers that a drive profile names, as a drive holds them. What is read and what is written may
// be two images at one address.
#pragma once

#include "host_sim/drive/drive_model.hpp"
#include "splinefeed/hal/modbus/profile/drive_profile.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace splinefeed::host {

class RegisterFile {
public:
    explicit RegisterFile(const hal::modbus::DriveProfile& profile);

    /// A number is read and written whole or not at all, and a frame begins with a number: else illegal_address.
    /// Between the numbers registers read as 0, and cannot be written. A value out of its range: illegal_value.
    [[nodiscard]] ModbusException read(int address, std::span<std::uint16_t> out) const;
    [[nodiscard]] ModbusException write(int address, std::span<const std::uint16_t> values);

    /// What was written, or what will be read.
    [[nodiscard]] std::int64_t raw(hal::modbus::FieldIndex index) const;
    void set(hal::modbus::FieldIndex index, std::int64_t raw);
    /// Whether the last write held the field.
    [[nodiscard]] bool was_written(hal::modbus::FieldIndex index) const;
    void reset();
    /// Words of wide numbers the other way round, from now on; or back.
    void swap_words();

private:
    static constexpr std::uint32_t nobody = 0xFFFFFFFF;
    static constexpr int addresses = 65536;

    [[nodiscard]] bool whole(const std::vector<std::uint32_t>& owner, int address, std::size_t count) const;
    [[nodiscard]] std::span<std::uint16_t> image_of(const hal::modbus::RegisterField& field);

    std::vector<hal::modbus::RegisterField> fields_; // in the word order of now
    std::vector<std::uint16_t> read_;
    std::vector<std::uint16_t> written_;
    std::vector<std::uint32_t> reader_; // the field that has a register, or nobody
    std::vector<std::uint32_t> writer_;
    int last_address_ = 0;
    std::size_t last_count_ = 0;
};

} // namespace splinefeed::host
