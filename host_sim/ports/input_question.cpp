// SPDX-License-Identifier: MIT
#include "host_sim/ports/input_question.hpp"

#include <cmath>

namespace splinefeed::host {

InputQuestion::InputQuestion(InputWait wait, double timeout_s, std::uint64_t now_us) noexcept
    : wait_(wait), until_us_(now_us + static_cast<std::uint64_t>(std::llround(timeout_s * 1e6))) {}

std::optional<int> InputQuestion::take(bool active, std::uint64_t asked_us) noexcept {
    const bool changed = before_ && *before_ != active;
    before_ = active;
    bool met = false;
    switch (wait_) {
    case InputWait::now: met = true; break;
    case InputWait::rise: met = changed && active; break;
    case InputWait::fall: met = changed && !active; break;
    case InputWait::high: met = active; break;
    case InputWait::low: met = !active; break;
    }
    if (met) {
        return active ? 1 : 0;
    }
    return asked_us >= until_us_ ? std::optional(timed_out) : std::nullopt;
}

} // namespace splinefeed::host
