// SPDX-License-Identifier: MIT
// ParameterTable: the memory for a program's parameters, #1 and #<name>. SystemParameters: those of the control.
#pragma once

#include "splinefeed/s0_program/decimal.hpp"

#include <string_view>

namespace splinefeed {

/// The caller's memory for parameters. Subroutines give each call its own #1 to #30 and local names behind it.
class ParameterTable {
public:
    /// #number, 1 to 5602 but for those of the control. False: it has no value yet (it reads as 0).
    [[nodiscard]] virtual bool read(std::int32_t number, Decimal& out) const noexcept = 0;
    /// False: there is no room for it.
    virtual bool write(std::int32_t number, Decimal value) noexcept = 0;
    /// #<name>, as it is written: names differ neither by case nor by spaces. A leading _ makes it global. False: it
    /// has no value.
    [[nodiscard]] virtual bool read(std::string_view name, Decimal& out) const noexcept = 0;
    virtual bool write(std::string_view name, Decimal value) noexcept = 0;

protected:
    ~ParameterTable() = default;
};

/// Parameters that the interpreter itself holds: #5061 to #5069 and #5070 (probe), #5161, #5181 (G28, G30), #5210 to
/// #5390 (offsets), #5399 (M66), #5400 to #5428 (tool, position), and names such as #<_x>.
class SystemParameters {
public:
    /// Whether the number is one of them; the ParameterTable is not asked for those.
    [[nodiscard]] virtual bool owns(std::int32_t number) const noexcept = 0;
    [[nodiscard]] virtual Decimal read(std::int32_t number) const noexcept = 0;
    [[nodiscard]] virtual bool can_write(std::int32_t number) const noexcept = 0;
    /// False: it cannot be written.
    virtual bool write(std::int32_t number, Decimal value) noexcept = 0;
    /// False: it is none of the control's names.
    [[nodiscard]] virtual bool read(std::string_view name, Decimal& out) const noexcept = 0;

protected:
    ~SystemParameters() = default;
};

} // namespace splinefeed
