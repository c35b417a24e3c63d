// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/line_history.hpp"

#include <algorithm>
#include <iterator>

namespace splinefeed::host {

void LineHistory::add(std::uint64_t line) {
    if (runs_.empty() || runs_.back().line != line) {
        runs_.push_back({moves_, line});
        if (runs_.size() > most) {
            runs_.pop_front();
        }
    }
    ++moves_;
}

std::uint64_t LineHistory::line_of(std::uint64_t move) const noexcept {
    const auto behind = std::ranges::upper_bound(runs_, move, {}, &Run::first_move);
    return behind == runs_.begin() || move >= moves_ ? 0 : std::prev(behind)->line;
}

void LineHistory::forget_before(std::uint64_t move) noexcept {
    while (runs_.size() > 1 && runs_[1].first_move <= move) {
        runs_.pop_front();
    }
}

} // namespace splinefeed::host
