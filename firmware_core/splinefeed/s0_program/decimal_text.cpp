// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/decimal_text.hpp"

namespace splinefeed {

namespace {

constexpr bool is_digit(char c) noexcept {
    return c >= '0' && c <= '9';
}

} // namespace

Status read_decimal(TextCursor& text, Decimal& out) noexcept {
    const bool negative = text.take('-');
    if (!negative) {
        text.take('+');
    }
    std::int64_t whole = 0;
    bool digits = false;
    while (is_digit(text.peek())) {
        if (whole <= largest_number) { // beyond that it stays too large
            whole = 10 * whole + (text.peek() - '0');
        }
        digits = true;
        text.step();
    }
    std::int64_t part = 0;
    if (text.take('.')) {
        std::int64_t place = Decimal::one;
        while (is_digit(text.peek())) {
            const int digit = text.peek() - '0';
            if (place > 1) {
                place /= 10;
                part += place * digit;
            } else if (place == 1) { // the tenth decimal rounds
                place = 0;
                part += digit >= 5 ? 1 : 0;
            }
            digits = true;
            text.step();
        }
    }
    if (!digits) {
        return Error::number_invalid;
    }
    if (whole > largest_number) {
        return Error::number_out_of_range;
    }
    const std::int64_t size = whole * Decimal::one + part;
    if (size > largest_number * Decimal::one) {
        return Error::number_out_of_range;
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
