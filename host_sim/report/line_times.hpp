// SPDX-License-Identifier: MIT
// LineTimes and LayerTimes: when the lines and the layers of a program were executed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace splinefeed::host {

/// Memory: 32 bytes a line, of the first most_lines lines.
class LineTimes {
public:
    static constexpr std::uint64_t most_lines = 4'000'000;

    struct Line {
        double start_s = -1.0; ///< for the first time; below 0: never
        double seconds = 0.0;  ///< altogether
        float way_mm = 0.0F;   ///< as programmed
        float weight = 0.0F;
        std::uint8_t code = 0; ///< of the limit that bound longest
    };

    /// A part of the run. @param line  from 1; 0: unknown
    void add(std::uint64_t line, double start_s, double seconds, std::uint8_t code);

    /// A move of the line, over all axes.
    void programmed(std::uint64_t line, double way_mm);

    /// By their number; the first one is no line.
    [[nodiscard]] const std::vector<Line>& lines() const noexcept { return lines_; }
    /// The numbers of those that took most time, the longest first.
    [[nodiscard]] std::vector<std::uint64_t> slowest(std::size_t most) const;

private:
    Line* at(std::uint64_t line);

    std::vector<Line> lines_;
};

/// Gets what a run does, in order of time. A layer lasts until the next one begins. A level above the last layer to
/// which the tool only lifts between two places of it is none. Memory: 16 bytes a layer. Cost of a part: some
/// comparisons.
class LayerTimes {
public:
    static constexpr std::size_t most_layers = 65536;

    struct Layer {
        double height_mm = 0.0;
        double start_s = 0.0;
    };

    /// A part in which the tool works. @param way_mm  of the tool, in space
    void add(double from_mm, double to_mm, double way_mm, double start_s, double seconds);
    /// The layers so far. None: what the program does is not like this, or there are fewer than three or too many.
    [[nodiscard]] std::vector<Layer> layers() const;

private:
    void settle();

    std::vector<Layer> layers_; // each is higher than the one before
    Layer level_{};             // that holds now
    int parts_ = 0;             // of it
    double level_s_ = 0.0;      // on levels that are layers
    double all_s_ = 0.0;
};

} // namespace splinefeed::host
