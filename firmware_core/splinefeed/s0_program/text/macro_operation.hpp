// SPDX-License-Identifier: MIT
// macro_operation: operators and functions as Fanuc's custom macro B has them, where they differ from LinuxCNC's.
#pragma once

#include "splinefeed/s0_program/text/operation.hpp"
#include "splinefeed/s0_program/text/parameter_table.hpp"

namespace splinefeed {

/// Whether it takes its operands bit by bit. Beside another operator such a one stands in brackets.
[[nodiscard]] constexpr bool is_logic(Operator name) noexcept {
    return name == Operator::logic_and || name == Operator::logic_or || name == Operator::logic_xor;
}

/// An operand that is vacant is 0, but for EQ and NE: these tell it from 0. AND, OR and XOR take whole numbers from 0
/// to 2^31 - 1, MOD takes whole numbers, and its result has the sign of `a`. Errors: as apply(), and integer_needed.
ProgramStatus apply_macro(Operator name, Decimal a, Decimal b, Decimal& out) noexcept;

/// FIX cuts off, FUP goes away from 0; ASIN is 270 to 360 for a negative argument. An argument that is vacant is 0.
/// @param unit  above 0: ROUND rounds to its multiples, and a half away from 0
/// Errors: as apply().
ProgramStatus apply_macro(Function name, Decimal x, Decimal unit, Decimal& out) noexcept;

/// An angle from 0 to below 360 degrees, where LinuxCNC's is -180 to 180.
[[nodiscard]] constexpr Decimal positive_angle(Decimal degrees) noexcept {
    return {degrees.raw < 0 ? degrees.raw + Decimal::full_turn : degrees.raw};
}

/// In arithmetic no value is 0.
[[nodiscard]] constexpr Decimal value_or_zero(Decimal value) noexcept {
    return value == vacant ? Decimal{} : value;
}

} // namespace splinefeed
