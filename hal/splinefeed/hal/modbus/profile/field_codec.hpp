// SPDX-License-Identifier: MIT
// FieldCodec: converts physical values to the registers of a field and back, in integers.
#pragma once

#include "splinefeed/hal/modbus/profile/drive_profile.hpp"

#include <cstdint>
#include <span>

namespace splinefeed::hal::modbus {

/// Physical values are fixed-point numbers with 16 fraction bits: units of 1/65536 count, count/s, ...
inline constexpr int physical_bits = 16;
inline constexpr double physical_one = 1 << physical_bits; ///< a physical value of 1

struct RawValue {
    std::int64_t raw = 0;
    bool clamped = false; ///< the value was outside [lowest, highest] of the field
};

/// raw = physical * numerator / denominator (or its inverse), rounded once to the nearest, ties upwards, within
/// [lowest, highest]. With `inverse`, 0 becomes the field's extreme value with the sign of the scale. Exact for every
/// value.
[[nodiscard]] RawValue raw_of(const RegisterField& field, std::int64_t physical_q16) noexcept;

/// The physical value of a raw one, rounded to the nearest; saturates at +-2^63. The inverse of 0 saturates, too.
[[nodiscard]] std::int64_t physical_of(const RegisterField& field, std::int64_t raw) noexcept;

/// Raw to registers, in the field's word and byte order: the low width_bits of it. @pre room for field.registers()
void put_raw(const RegisterField& field, std::int64_t raw, std::span<std::uint16_t> out) noexcept;
/// Registers to raw, sign-extended where the field is signed. @pre in.size() >= field.registers()
[[nodiscard]] std::int64_t take_raw(const RegisterField& field, std::span<const std::uint16_t> in) noexcept;

} // namespace splinefeed::hal::modbus
