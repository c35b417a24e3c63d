// SPDX-License-Identifier: MIT
#include "host_sim/ports/gpio/gpio_switches.hpp"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <utility>

namespace splinefeed::host {

// The first trouble is told. Coils are those of others.
std::string GpioSwitches::turn(const SwitchTurn& turn) {
    const auto* const line = std::get_if<SwitchedLine>(turn.line);
    if (line == nullptr || chips_.set(*line, turn.on)) {
        return {};
    }
    const int error = errno;
    std::string name = name_of_output(*lines_, line->line);
    if (trouble_.empty()) {
        trouble_ = fmt::format("{} cannot be set: {}", name, std::strerror(error));
    }
    return name;
}

void GpioSwitches::act(EventKind kind, std::int32_t number) {
    const std::lock_guard lock(mutex_);
    if (ended_ || !trouble_.empty()) {
        return;
    }
    for (const SwitchTurn& each : switch_turns(*lines_, kind, number)) {
        turn(each);
    }
}

// A line that fails does not keep the others from being safe.
void GpioSwitches::end() noexcept {
    const std::lock_guard lock(mutex_);
    if (std::exchange(ended_, true)) {
        return;
    }
    for (const SwitchTurn& each : safe_turns(*lines_)) {
        const std::string name = turn(each);
        unset_ = unset_.empty() ? name : unset_;
    }
}

std::string GpioSwitches::unconfirmed() const {
    const std::lock_guard lock(mutex_);
    return unset_;
}

std::string GpioSwitches::trouble() const {
    const std::lock_guard lock(mutex_);
    return trouble_;
}

} // namespace splinefeed::host
