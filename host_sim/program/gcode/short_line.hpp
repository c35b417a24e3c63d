// SPDX-License-Identifier: MIT
// ShortLine: a line without the text of its comments, where it is longer than a line of the interpreter.
#pragma once

#include "splinefeed/s0_program/text/text_part.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace splinefeed::host {

/// Comments have any length: posts write their options into one, and slicers their settings.
class ShortLine {
public:
    /// @param line  must outlive the use of what the others return
    /// @param open_comments  as DialectRules
    /// @param longest  characters of a line that stays as it is
    void take(std::string_view line, bool open_comments, std::size_t longest);
    /// For the interpreter: the same words, and comments that ask for the same.
    [[nodiscard]] std::string_view text() const noexcept { return is_short_ ? std::string_view(short_) : line_; }
    /// Where a character of text() stands in the line, both from 0.
    [[nodiscard]] std::size_t place(std::size_t at) const noexcept;
    /// The text of a comment that begins at a character of text(), as it stands in the line.
    [[nodiscard]] std::string_view comment(std::size_t at) const noexcept;
    /// Where it stands in the line, from 0.
    [[nodiscard]] std::size_t comment_place(std::size_t at) const noexcept { return at > 0 ? place(at - 1) + 1 : 0; }

private:
    void drop(std::size_t size);

    std::string_view line_;
    std::string short_;
    std::vector<std::pair<std::size_t, std::size_t>> dropped_; // from this character on, and how many before it
    bool is_short_ = false;
};

} // namespace splinefeed::host
