// SPDX-License-Identifier: MIT
#include "host_sim/report/line_times.hpp"

#include <algorithm>

namespace splinefeed::host {

void LineTimes::add(std::uint64_t line, double start_s, double seconds, std::uint8_t code) {
    if (line == 0 || line > most_lines) {
        return;
    }
    if (lines_.size() <= line) {
        lines_.resize(line + 1);
    }
    Line& of = lines_[line];
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

} // namespace splinefeed::host
