// SPDX-License-Identifier: MIT
#include "splinefeed/controller/line_numbers.hpp"

namespace splinefeed {

void LineNumbers::add(std::uint32_t move, std::uint32_t line) noexcept {
    if (count_ > 0) {
        Run& last = runs_[(next_ - 1) % most_runs];
        if (moves_ == 1) {
            last.step = line - last.line;
        }
        if (line == last.line + last.step * moves_) {
            ++moves_;
            return;
        }
    }
    runs_[next_++ % most_runs] = {move, line, 0};
    count_ = count_ < most_runs ? count_ + 1 : count_;
    moves_ = 1;
}

std::uint32_t LineNumbers::find(std::uint32_t move) const noexcept {
    for (std::uint32_t back = 1; back <= count_; ++back) {
        const Run& found = run(next_ - back);
        const std::uint32_t way = move - found.move;
        if (static_cast<std::int32_t>(way) >= 0) {
            return back > 1 || way < moves_ ? found.line + found.step * way : 0;
        }
    }
    return 0;
}

} // namespace splinefeed
