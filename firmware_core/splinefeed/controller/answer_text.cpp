// SPDX-License-Identifier: MIT
#include "splinefeed/controller/answer_text.hpp"

#include <array>

namespace splinefeed {

AnswerText& AnswerText::put(char c) noexcept {
    if (used_ < memory_.size()) {
        memory_[(first_ + used_++) % memory_.size()] = c;
    }
    return *this;
}

AnswerText& AnswerText::put(std::string_view text) noexcept {
    for (const char c : text) {
        put(c);
    }
    return *this;
}

AnswerText& AnswerText::integer(std::int64_t value) noexcept {
    return decimal({value}, 0 - Decimal::digits);
}

// The digits of raw, from the last one on. Below 0 decimals raw is the integer itself.
AnswerText& AnswerText::decimal(Decimal value, int decimals) noexcept {
    std::uint64_t left =
        value.raw < 0 ? 0U - static_cast<std::uint64_t>(value.raw) : static_cast<std::uint64_t>(value.raw);
    const bool whole = decimals < 0;
    for (int i = decimals; !whole && i < Decimal::digits; ++i) {
        left = i + 1 == Decimal::digits ? (left + 5) / 10 : left / 10; // the last cut rounds
    }
    std::array<char, 24> digits{};
    std::size_t count = 0;
    do {
        digits[count++] = static_cast<char>('0' + left % 10);
        left /= 10;
    } while (left > 0);
    const std::size_t behind = whole ? 0 : static_cast<std::size_t>(decimals);
    while (count <= behind) {
        digits[count++] = '0';
    }
    bool zero = true;
    for (std::size_t i = 0; i < count; ++i) {
        zero = zero && digits[i] == '0';
    }
    if (value.raw < 0 && !zero) {
        put('-');
    }
    while (count > 0) {
        if (count == behind) {
            put('.');
        }
        put(digits[--count]);
    }
    return *this;
}

std::size_t AnswerText::take(std::span<char> out) noexcept {
    const std::size_t count = used_ < out.size() ? used_ : out.size();
    for (std::size_t i = 0; i < count; ++i) {
        out[i] = memory_[(first_ + i) % memory_.size()];
    }
    first_ = memory_.empty() ? 0 : (first_ + count) % memory_.size();
    used_ -= count;
    return count;
}

} // namespace splinefeed
