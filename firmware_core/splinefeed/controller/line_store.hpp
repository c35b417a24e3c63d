// SPDX-License-Identifier: MIT
// LineStore: the lines of a sender that are still to be executed.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace splinefeed {

/// A line as it is taken out.
struct StoredLine {
    static constexpr std::size_t longest = 256;

    std::array<char, longest> text{};
    std::size_t size = 0;
    bool too_long = false; ///< what is kept of it is empty

    [[nodiscard]] std::string_view view() const noexcept { return {text.data(), size}; }
};

/// A ring of characters in the caller's memory. A carriage return, a line feed, or both, one by one, end a line.
/// A line may have StoredLine::longest characters. Behind the 160th, comments and spaces are left out and do not count.
class LineStore {
public:
    /// `memory` must outlive it.
    explicit LineStore(std::span<char> memory) noexcept : memory_(memory) {}

    /// Takes a character of a line, or of its end. false: the memory is full, and the line that comes is lost.
    bool add(char c) noexcept;
    /// Whether the characters that come now are a comment.
    [[nodiscard]] bool in_comment() const noexcept { return comment_ != '\0'; }

    /// Complete lines.
    [[nodiscard]] std::size_t lines() const noexcept { return lines_; }
    /// Whether something has come of a line that has no end yet.
    [[nodiscard]] bool has_partial() const noexcept { return partial_ > 0; }
    /// Whether the first one begins like this, spaces left out. @pre lines() > 0
    [[nodiscard]] bool begins(std::string_view word) const noexcept;
    /// Takes the first one out. @pre lines() > 0
    void take(StoredLine& out) noexcept;
    /// Forgets all lines, also that which comes.
    void clear() noexcept;
    /// Forgets what has come of a line that has no end yet.
    void drop_partial() noexcept;
    [[nodiscard]] std::size_t room() const noexcept { return memory_.size() - used_; }

private:
    static constexpr char too_long_mark = '\x01';
    static constexpr std::size_t most_comment = 160;

    [[nodiscard]] char at(std::size_t i) const noexcept { return memory_[(first_ + i) % memory_.size()]; }
    bool put(char c) noexcept;
    bool end_line() noexcept;
    void note_comment(char c) noexcept;

    std::span<char> memory_;
    std::size_t first_ = 0;
    std::size_t used_ = 0;
    std::size_t partial_ = 0; // characters of the line that comes
    std::size_t lines_ = 0;
    char comment_ = '\0'; // ( or ;
    bool after_return_ = false;
    bool too_long_ = false;
    bool lost_ = false;
    bool cut_ = false; // the comment's ( was left out
};

} // namespace splinefeed
