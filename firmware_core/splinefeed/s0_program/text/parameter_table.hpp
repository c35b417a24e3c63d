// SPDX-License-Identifier: MIT
// ParameterTable: the memory for a program's parameters, #1 and #<name>.
#pragma once

#include "splinefeed/s0_program/text/decimal.hpp"

#include <limits>
#include <string_view>

namespace splinefeed {

/// No value, which is another than 0 in dialects with macros: #0. It is no value of a program elsewhere.
inline constexpr Decimal vacant{std::numeric_limits<std::int64_t>::min()};

enum class ParameterAccess : std::uint8_t { read, write };

/// The caller's memory for parameters. Subroutines give each call its own #1 to #30 and local names behind it.
/// A write of `vacant` is one of a value that is none: a read then gives it, or returns false.
class ParameterTable {
public:
    /// `#number`, 1 to 5602 but for those of the control. False: it has no value yet (it reads as 0).
    [[nodiscard]] virtual bool read(std::int32_t number, Decimal& out) const noexcept = 0;
    /// False: there is no room for it.
    virtual bool write(std::int32_t number, Decimal value) noexcept = 0;
    /// `#<name>`, as it is written: names differ neither by case nor by spaces. A leading _ makes it global. False: it
    /// has no value.
    [[nodiscard]] virtual bool read(std::string_view name, Decimal& out) const noexcept = 0;
    virtual bool write(std::string_view name, Decimal value) noexcept = 0;
    /// It has no value any more: a block that wrote it is refused.
    virtual void forget(std::int32_t number) noexcept = 0;
    virtual void forget(std::string_view name) noexcept = 0;
    /// In dialects with macros: whether a program that reads or sets the number is refused. There numbers from 1000 on
    /// are of the control, the machine or the time. @param owned  whether it is one that the interpreter holds
    [[nodiscard]] virtual bool refuses(std::int32_t number, ParameterAccess /*access*/, bool owned) const noexcept {
        return number >= 1000 && !owned;
    }

protected:
    ~ParameterTable() = default;
};

} // namespace splinefeed
