// SPDX-License-Identifier: MIT
// LineHistory: the lines of a program that the moves on their way came from.
#pragma once

#include <cstdint>
#include <deque>

namespace splinefeed::host {

/// Moves are counted from 0. Memory: the moves between what was read and what was travelled, at most `most`; of older
/// ones the line is forgotten.
class LineHistory {
public:
    static constexpr std::size_t most = 1U << 16U;

    /// The next move is from this line.
    void add(std::uint64_t line);
    [[nodiscard]] std::uint64_t moves() const noexcept { return moves_; }
    /// 0: unknown.
    [[nodiscard]] std::uint64_t line_of(std::uint64_t move) const noexcept;
    /// Nobody asks for moves before this one any more.
    void forget_before(std::uint64_t move) noexcept;

private:
    struct Run {
        std::uint64_t first_move = 0;
        std::uint64_t line = 0;
    };

    std::deque<Run> runs_;
    std::uint64_t moves_ = 0;
};

} // namespace splinefeed::host
