// SPDX-License-Identifier: MIT
// operation: the operators and functions of an expression.
#pragma once

#include "splinefeed/s0_program/text/decimal.hpp"
#include "splinefeed/s0_program/text/program_errors.hpp"
#include "splinefeed/s0_program/text/text_cursor.hpp"

namespace splinefeed {

enum class Operator : std::uint8_t {
    none,
    power,
    times,
    divided,
    modulo,
    plus,
    minus,
    eq,
    ne,
    gt,
    ge,
    lt,
    le,
    logic_and,
    logic_or,
    logic_xor
};

inline constexpr int strongest_level = 5;

/// An operator with its level: 1 binds least, strongest_level (**) most.
struct OperatorRow {
    std::string_view text;
    Operator name;
    int level;
};

enum class Function : std::uint8_t {
    sine,
    cosine,
    tangent,
    asin,
    acos,
    atan,
    root,
    abs,
    exp,
    ln,
    round,
    fix,
    fup,
    exists
};

struct FunctionRow {
    std::string_view text;
    Function name;
};

/// The operator or function that the text goes on with, which is stepped over; null: none.
[[nodiscard]] const OperatorRow* take_operator(TextCursor& text) noexcept;
[[nodiscard]] const FunctionRow* take_function(TextCursor& text) noexcept;

/// 1 or 0.
[[nodiscard]] constexpr Decimal truth(bool value) noexcept {
    return {value ? Decimal::one : 0};
}

/// Arguments and results are within +-Decimal::largest_raw. Errors: division_by_zero, power_invalid,
/// result_out_of_range.
ProgramStatus apply(Operator name, Decimal a, Decimal b, Decimal& out) noexcept;

/// All but atan and exists. Errors: arc_function_argument, root_of_negative, logarithm_argument, result_out_of_range.
ProgramStatus apply(Function name, Decimal x, Decimal& out) noexcept;

} // namespace splinefeed
