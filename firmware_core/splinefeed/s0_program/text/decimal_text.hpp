// SPDX-License-Identifier: MIT
// decimal_text: numbers from text to integers.
#pragma once

#include "splinefeed/s0_program/text/decimal.hpp"
#include "splinefeed/s0_program/text/program_errors.hpp"
#include "splinefeed/s0_program/text/text_cursor.hpp"

namespace splinefeed {

/// Largest number in a program: sums of words cannot overflow.
inline constexpr std::int64_t largest_number = 100'000'000;

/// Reads [+-]digits[.digits], with at least one digit and spaces anywhere. Up to nine decimals are exact; more are
/// rounded to nine, ties away from zero. Errors: number_invalid (there is no digit), number_out_of_range.
ProgramStatus read_decimal(TextCursor& text, Decimal& out) noexcept;

/// Whether a value is an integer within 1e-4, as RS274/NGC reads integers, and which one.
[[nodiscard]] bool to_integer(Decimal value, std::int32_t& out) noexcept;

} // namespace splinefeed
