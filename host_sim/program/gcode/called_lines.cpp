// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/called_lines.hpp"

namespace splinefeed::host {

std::uint32_t CalledLines::take(const SourceLine& line) {
    if (line.file == nullptr) {
        return static_cast<std::uint32_t>(line.number);
    }
    if (places_.size() == most) {
        places_.pop_front();
        front_ = (front_ + 1) % first;
    }
    places_.push_back({line.file, line.number, in_program_});
    return first + (front_ + static_cast<std::uint32_t>(places_.size()) - 1) % first;
}

LinePlace CalledLines::place(std::uint32_t number) const {
    if (number < first) {
        return {nullptr, number, number};
    }
    const std::size_t at = (number - front_) % first; // counted from the oldest one
    return places_[at < places_.size() ? at : 0];
}

} // namespace splinefeed::host
