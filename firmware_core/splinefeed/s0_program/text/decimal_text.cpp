// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/text/decimal_text.hpp"

namespace splinefeed {

namespace {

constexpr bool is_digit(char c) noexcept {
    return c >= '0' && c <= '9';
}

} // namespace

ProgramStatus read_decimal(TextCursor& text, Decimal& out) noexcept {
    const bool negative = text.take('-');
    if (!negative) {
        text.take('+');
    }
    std::uint32_t whole = 0; // 32 bits are enough, and quicker on a chip
    bool digits = false;
    while (is_digit(text.peek())) {
        if (whole <= largest_number) { // beyond that it stays too large
            whole = 10 * whole + static_cast<std::uint32_t>(text.peek() - '0');
        }
        digits = true;
        text.step();
    }
    std::uint32_t part = 0;
    if (text.take('.')) {
        int places = 0;
        for (; is_digit(text.peek()); text.step()) {
            const auto digit = static_cast<std::uint32_t>(text.peek() - '0');
            if (places < Decimal::digits) {
                part = 10 * part + digit;
            } else if (places == Decimal::digits) { // the tenth decimal rounds
                part += digit >= 5 ? 1U : 0U;
            }
            ++places;
            digits = true;
        }
        for (; places < Decimal::digits; ++places) {
            part *= 10;
        }
    }
    if (!digits) {
        return ProgramError::number_invalid;
    }
    if (whole > largest_number) {
        return ProgramError::number_out_of_range;
    }
    const std::int64_t size = whole * Decimal::one + part;
    if (size > largest_number * Decimal::one) {
        return ProgramError::number_out_of_range;
    }
    out.raw = negative ? -size : size;
    return {};
}

bool to_integer(Decimal value, std::int32_t& out) noexcept {
    constexpr std::int64_t near = Decimal::one / 10000;
    const std::int64_t half = value.raw < 0 ? -(Decimal::one / 2) : Decimal::one / 2;
    const std::int64_t whole = (value.raw + half) / Decimal::one;
    const std::int64_t apart = value.raw - whole * Decimal::one;
    if (apart > near || apart < -near || whole > largest_number || whole < -largest_number) {
        return false;
    }
    out = static_cast<std::int32_t>(whole);
    return true;
}

} // namespace splinefeed
