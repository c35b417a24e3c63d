// SPDX-License-Identifier: MIT
// LineNumbers: the line of the program that each move of a path comes from.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace splinefeed {

/// Moves are numbered from 0, modulo 2^32. Moves whose lines go in equal steps are one run: those of a program
/// with a move in each line, or with numbers in tens. Of more than 64 runs the
/// oldest are forgotten. Memory: 0.8 KB. Cost: add() constant, find() the runs behind the move.
class LineNumbers {
public:
    void clear() noexcept { count_ = 0; }
    /// The next move. @pre move is one more than that of the call before
    void add(std::uint32_t move, std::uint32_t line) noexcept;
    /// The line of a move; 0: it is not known.
    [[nodiscard]] std::uint32_t find(std::uint32_t move) const noexcept;

private:
    static constexpr std::size_t most_runs = 64;
    struct Run {
        std::uint32_t move = 0; // the first one
        std::uint32_t line = 0; // of that
        std::uint32_t step = 0; // from line to line, modulo 2^32
    };

    [[nodiscard]] const Run& run(std::uint32_t number) const noexcept { return runs_[number % most_runs]; }

    std::array<Run, most_runs> runs_{};
    std::uint32_t next_ = 0;  // the next run
    std::uint32_t count_ = 0; // runs that are known, most_runs at most
    std::uint32_t moves_ = 0; // of the last run
};

} // namespace splinefeed
