// SPDX-License-Identifier: MIT
// RegisterFile: the registers and bits that a drive profile names, as the drive holds them. Reading and writing may use
// two different images at one address.
#pragma once

#include "host_sim/drive/drive_model.hpp"
#include "splinefeed/hal/modbus/profile/drive_profile.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace splinefeed::host {

/// The raw value of a field with the test true or false.
[[nodiscard]] std::int64_t with_test(std::int64_t raw, const hal::modbus::FieldTest& test, bool truth);

class RegisterFile {
public:
    explicit RegisterFile(const hal::modbus::DriveProfile& profile);

    /// A number is read and written as a whole, and a frame begins with a number; otherwise illegal_address. Registers
    /// between the numbers read as 0 and cannot be written. A value out of its range gives illegal_value.
    [[nodiscard]] ModbusException read(int place, std::span<std::uint16_t> out) const;
    [[nodiscard]] ModbusException write(int place, std::span<const std::uint16_t> values);

    /// The value that was written, or that will be read.
    [[nodiscard]] std::int64_t raw(hal::modbus::FieldIndex index) const;
    void set(hal::modbus::FieldIndex index, std::int64_t raw);
    /// Whether the last write contained the field.
    [[nodiscard]] bool was_written(hal::modbus::FieldIndex index) const;
    void reset();
    /// Reverses the word order of numbers of several registers, from now on; a second call restores it.
    void swap_words();

private:
    static constexpr std::uint32_t nobody = 0xFFFFFFFF;
    [[nodiscard]] bool in_table(int place, std::size_t count) const;
    [[nodiscard]] bool whole(const std::vector<std::uint32_t>& owner, int place, std::size_t count) const;
    [[nodiscard]] std::span<std::uint16_t> image_of(const hal::modbus::RegisterField& field);

    std::vector<hal::modbus::RegisterField> fields_; // in the present word order
    int places_;                                     // of the tables up to the last one that a field is in
    std::vector<std::uint16_t> read_;
    std::vector<std::uint16_t> written_;
    std::vector<std::uint32_t> reader_; // for each register the field to which it belongs, or nobody
    std::vector<std::uint32_t> writer_;
    int last_place_ = 0;
    std::size_t last_count_ = 0;
};

} // namespace splinefeed::host
