// SPDX-License-Identifier: MIT
#include "host_sim/report/line_times.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::host {

namespace {

constexpr double finest_mm = 1e-6; // of positions
constexpr double steepest = 1e-5;  // of what is level; a vase of 0.1 mm a turn, 1 m around, is ten times as steep
constexpr double same_mm = 1e-3;   // heights of one layer
constexpr int least_parts = 2;     // a rounded corner is level for a moment
constexpr std::size_t least_layers = 3;
constexpr double least_share = 0.7; // of the time, that is spent on levels

} // namespace

// Null: it is not kept.
LineTimes::Line* LineTimes::at(std::uint64_t line) {
    if (line == 0 || line > most_lines) {
        return nullptr;
    }
    if (lines_.size() <= line) {
        lines_.resize(line + 1);
    }
    return &lines_[line];
}

void LineTimes::programmed(std::uint64_t line, double way_mm) {
    if (Line* const of = at(line)) {
        of->way_mm += static_cast<float>(way_mm);
    }
}

void LineTimes::add(std::uint64_t line, double start_s, double seconds, std::uint8_t code) {
    Line* const found = at(line);
    if (found == nullptr) {
        return;
    }
    Line& of = *found;
    const auto time = static_cast<float>(seconds);
    if (of.start_s < 0.0) {
        of.start_s = start_s;
    }
    of.seconds += seconds;
    if (of.code == code) {
        of.weight += time;
    } else if ((of.weight -= time) < 0.0F) { // the vote of Boyer and Moore
        of.code = code;
        of.weight = -of.weight;
    }
}

std::vector<std::uint64_t> LineTimes::slowest(std::size_t most) const {
    std::vector<std::uint64_t> numbers;
    for (std::uint64_t line = 1; line < lines_.size(); ++line) {
        if (lines_[line].seconds > 0.0) {
            numbers.push_back(line);
        }
    }
    const auto end = numbers.begin() + static_cast<std::ptrdiff_t>(std::min(most, numbers.size()));
    std::partial_sort(numbers.begin(), end, numbers.end(), [this](std::uint64_t a, std::uint64_t b) {
        return lines_[a].seconds > lines_[b].seconds || (lines_[a].seconds == lines_[b].seconds && a < b);
    });
    numbers.erase(end, numbers.end());
    return numbers;
}

void LayerTimes::add(double from_mm, double to_mm, double way_mm, double start_s, double seconds) {
    all_s_ += seconds;
    if (std::fabs(to_mm - from_mm) > finest_mm + steepest * way_mm) {
        parts_ = 0;
        return;
    }
    level_s_ += seconds;
    if (parts_ == 0 || std::fabs(to_mm - level_.height_mm) > finest_mm + steepest * way_mm) {
        level_ = {to_mm, start_s};
        parts_ = 0;
    }
    if (++parts_ == least_parts) {
        settle();
    }
}

// Levels above the new one are no layers: the tool has come down from them.
void LayerTimes::settle() {
    for (double until_s = level_.start_s; !layers_.empty() && layers_.back().height_mm > level_.height_mm + same_mm;) {
        level_s_ -= until_s - layers_.back().start_s;
        until_s = layers_.back().start_s;
        layers_.pop_back();
    }
    const bool new_one = layers_.empty() || layers_.back().height_mm < level_.height_mm - same_mm;
    if (new_one && layers_.size() < most_layers) {
        layers_.push_back(level_);
    }
}

std::vector<LayerTimes::Layer> LayerTimes::layers() const {
    const bool fits = layers_.size() >= least_layers && layers_.size() < most_layers;
    return fits && level_s_ > least_share * all_s_ ? layers_ : std::vector<Layer>{};
}

} // namespace splinefeed::host
