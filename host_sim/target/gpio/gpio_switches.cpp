// SPDX-License-Identifier: MIT
#include "host_sim/target/gpio/gpio_switches.hpp"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <utility>

namespace splinefeed::host {

// The first trouble is told.
void GpioSwitches::turn(const SwitchedLine& line, bool on) {
    if (!chips_.set(line, on) && trouble_.empty()) {
        trouble_ = fmt::format("{} cannot be set: {}", name_of_output(*lines_, line.line), std::strerror(errno));
    }
}

void GpioSwitches::act(EventKind kind, std::int32_t number) {
    const std::lock_guard lock(mutex_);
    if (ended_ || !trouble_.empty()) {
        return;
    }
    const bool on = kind == EventKind::mist_on || kind == EventKind::flood_on ||
                    kind == EventKind::output_on_with_motion || kind == EventKind::output_on;
    if (lines_->mist && (kind == EventKind::mist_on || kind == EventKind::coolant_off)) {
        turn(*lines_->mist, on);
    }
    if (lines_->flood && (kind == EventKind::flood_on || kind == EventKind::coolant_off)) {
        turn(*lines_->flood, on);
    }
    const DigitalOutput* const output = lines_->output(number);
    if (output != nullptr && (kind == EventKind::output_on_with_motion || kind == EventKind::output_on ||
                              kind == EventKind::output_off_with_motion || kind == EventKind::output_off)) {
        turn(output->line, on);
    }
}

// A line that fails does not keep the others from being safe.
void GpioSwitches::end() noexcept {
    const std::lock_guard lock(mutex_);
    if (std::exchange(ended_, true)) {
        return;
    }
    for (const auto& line : {lines_->mist, lines_->flood}) {
        if (line) {
            turn(*line, false);
        }
    }
    for (const DigitalOutput& output : lines_->outputs) {
        turn(output.line, output.safe_on);
    }
}

std::string GpioSwitches::trouble() const {
    const std::lock_guard lock(mutex_);
    return trouble_;
}

} // namespace splinefeed::host
