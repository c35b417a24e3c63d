// SPDX-License-Identifier: MIT
// TextCursor: a place in a line of a program.
#pragma once

#include "splinefeed/s0_program/text/text_part.hpp"

#include <cstdint>
#include <string_view>

namespace splinefeed {

/// ASCII, whatever the locale.
[[nodiscard]] constexpr char lower_case(char c) noexcept {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}
[[nodiscard]] constexpr char upper_case(char c) noexcept {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

/// Goes through a line character by character. Spaces and tabs count nowhere but in comments, and case does not.
class TextCursor {
public:
    constexpr explicit TextCursor(std::string_view text) noexcept : text_(text) { skip(); }

    /// The character in lower case; 0 at the end.
    [[nodiscard]] constexpr char peek() const noexcept { return at_ < text_.size() ? lower_case(text_[at_]) : '\0'; }
    /// The one after it.
    [[nodiscard]] constexpr char peek_second() const noexcept {
        TextCursor other = *this;
        other.step();
        return other.peek();
    }
    constexpr void step() noexcept {
        ++at_;
        skip();
    }
    /// Steps over the character if it is this one.
    constexpr bool take(char c) noexcept {
        const bool here = peek() == c && c != '\0';
        if (here) {
            step();
        }
        return here;
    }
    /// Steps over the word if it is here. @param word in lower case
    constexpr bool take(std::string_view word) noexcept {
        TextCursor other = *this;
        for (const char c : word) {
            if (!other.take(c)) {
                return false;
            }
        }
        *this = other;
        return true;
    }
    [[nodiscard]] constexpr bool at_end() const noexcept { return at_ >= text_.size(); }
    /// From 1.
    [[nodiscard]] constexpr std::uint16_t column() const noexcept { return static_cast<std::uint16_t>(at_ + 1); }
    [[nodiscard]] constexpr std::string_view text() const noexcept { return text_; }
    [[nodiscard]] constexpr std::size_t at() const noexcept { return at_; }
    /// A part of the line, without the checks of std::string_view::substr, which throws. @pre begin <= end <= its size
    [[nodiscard]] constexpr std::string_view part(std::size_t begin, std::size_t end) const noexcept {
        return {text_.data() + begin, end - begin};
    }
    /// The same part by its place. @pre the line has at most 65535 characters
    [[nodiscard]] static constexpr TextPart place(std::size_t begin, std::size_t end) noexcept {
        return {static_cast<std::uint16_t>(begin), static_cast<std::uint16_t>(end - begin)};
    }
    /// Where the character is next, from `from` on; the end of the line if nowhere.
    [[nodiscard]] constexpr std::size_t find(char c, std::size_t from) const noexcept {
        while (from < text_.size() && text_[from] != c) {
            ++from;
        }
        return from;
    }
    constexpr void go_to(std::size_t at) noexcept {
        at_ = at;
        skip();
    }

private:
    constexpr void skip() noexcept {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) {
            ++at_;
        }
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

} // namespace splinefeed
