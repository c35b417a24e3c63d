// SPDX-License-Identifier: MIT
// CalledLines: numbers for lines of other files, which the program itself does not have.
#pragma once

#include "host_sim/program/source_line.hpp"

#include <cstdint>
#include <deque>

namespace splinefeed::host {

/// Where a line stands, and the line of the program that has called it: its own number, if it is of the program.
struct LinePlace {
    const std::string* file = nullptr; ///< null: the program's own
    std::uint64_t number = 0;
    std::uint64_t in_program = 0;
};

/// The interpreter holds lines back, and tells them by a number alone. Memory: the last `most` lines of other files;
/// older ones are told as the first one of them.
class CalledLines {
public:
    static constexpr std::uint32_t first = std::uint32_t{1} << 31U; ///< lines of the program have smaller numbers
    static constexpr std::size_t most = 1U << 16U;

    /// The number by which the interpreter takes a line that is read now. @pre line.number < first
    std::uint32_t take(const SourceLine& line);
    /// Of a number that take() gave.
    [[nodiscard]] LinePlace place(std::uint32_t number) const;
    /// A line that the flow has come to, also one that it keeps to itself: a call.
    void pass(const SourceLine& line) noexcept { in_program_ = line.file == nullptr ? line.number : in_program_; }
    /// The line of the program that was passed last.
    [[nodiscard]] std::uint64_t in_program() const noexcept { return in_program_; }

private:
    std::deque<LinePlace> places_;
    std::uint32_t front_ = 0; // the number of the first one of them, from `first`
    std::uint64_t in_program_ = 0;
};

} // namespace splinefeed::host
