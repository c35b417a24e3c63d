// SPDX-License-Identifier: MIT
// LineTimes: when the lines of a program were executed, and for how long.
#pragma once

#include <cstdint>
#include <vector>

namespace splinefeed::host {

/// Memory: 24 bytes a line, of the first most_lines lines.
class LineTimes {
public:
    static constexpr std::uint64_t most_lines = 4'000'000;

    struct Line {
        double start_s = -1.0; ///< for the first time; below 0: never
        double seconds = 0.0;  ///< altogether
        float weight = 0.0F;
        std::uint8_t code = 0; ///< of the limit that bound longest
    };

    /// A part of the run. @param line  from 1; 0: unknown
    void add(std::uint64_t line, double start_s, double seconds, std::uint8_t code);

    /// By their number; the first one is no line.
    [[nodiscard]] const std::vector<Line>& lines() const noexcept { return lines_; }
    /// The numbers of those that took most time, the longest first.
    [[nodiscard]] std::vector<std::uint64_t> slowest(std::size_t most) const;

private:
    std::vector<Line> lines_;
};

} // namespace splinefeed::host
