// SPDX-License-Identifier: MIT
// LayerTimes: programs that rise in layers, as printers' do: how high each layer lies, and when it begins.
#pragma once

#include <cstddef>
#include <vector>

namespace splinefeed::host {

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
