// SPDX-License-Identifier: MIT
// AnswerText: what the controller says, until its transport takes it.
#pragma once

#include "splinefeed/s0_program/text/decimal.hpp"

#include <cstddef>
#include <span>
#include <string_view>

namespace splinefeed {

/// A ring of characters in the caller's memory. What does not fit is lost: whoever writes asks room() first.
class AnswerText {
public:
    /// `memory` must outlive it.
    explicit AnswerText(std::span<char> memory) noexcept : memory_(memory) {}

    AnswerText& put(char c) noexcept;
    AnswerText& put(std::string_view text) noexcept;
    /// A literal, whose length is known: a firmware has no strlen.
    template <std::size_t size>
    AnswerText& put(const char (&text)[size]) noexcept {
        return put(std::string_view(text, size - 1));
    }
    AnswerText& integer(std::int64_t value) noexcept;
    /// Rounded to `decimals`, 0 to 9, ties away from zero.
    AnswerText& decimal(Decimal value, int decimals) noexcept;
    AnswerText& end_line() noexcept { return put("\r\n"); }

    [[nodiscard]] std::size_t room() const noexcept { return memory_.size() - used_; }
    [[nodiscard]] std::size_t size() const noexcept { return used_; }
    /// Moves characters out; returns how many.
    std::size_t take(std::span<char> out) noexcept;
    void clear() noexcept { used_ = 0; }

private:
    std::span<char> memory_;
    std::size_t first_ = 0;
    std::size_t used_ = 0;
};

} // namespace splinefeed
