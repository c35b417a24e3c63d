// SPDX-License-Identifier: MIT
#include "host_sim/base/interruption.hpp"

#include <utility>

namespace splinefeed::host {

thread_local Interruption* Interruption::current_ = nullptr;

Interruption::Interruption(std::function<void()> check)
    : outer_(std::exchange(current_, this)), check_(std::move(check)), due_(std::chrono::steady_clock::now() + period) {
}

Interruption::~Interruption() {
    current_ = outer_;
}

void Interruption::look() {
    if (++steps_ % steps_a_look != 0) {
        return;
    }
    if (const auto now = std::chrono::steady_clock::now(); now >= due_) {
        due_ = now + period;
        check_();
    }
}

} // namespace splinefeed::host
