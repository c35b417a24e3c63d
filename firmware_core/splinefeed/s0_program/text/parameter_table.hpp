// SPDX-License-Identifier: MIT
// ParameterTable: the memory for a program's parameters, #1 and #<name>.
#pragma once

#include "splinefeed/s0_program/text/decimal.hpp"

#include <string_view>

namespace splinefeed {

/// The caller's memory for parameters. Subroutines give each call its own #1 to #30 and local names behind it.
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

protected:
    ~ParameterTable() = default;
};

} // namespace splinefeed
