// SPDX-License-Identifier: MIT
#include "host_sim/ports/gpio/line_inputs.hpp"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>

namespace splinefeed::host {

bool LineInputs::watch(std::int32_t number) {
    const DigitalInput* const input = lines_->input(number);
    watched_ = input != nullptr ? std::get_if<SensedLine>(&input->line) : nullptr;
    number_ = number;
    return watched_ != nullptr;
}

std::optional<InputReading> LineInputs::take() {
    if (watched_ == nullptr) {
        return std::nullopt;
    }
    const std::uint64_t asked_us = clock_->now_us();
    const auto levels = chips_.source[watched_->line.chip]->levels();
    if (!levels) {
        const std::lock_guard lock(mutex_);
        trouble_ = fmt::format("the line of input {} cannot be read: {}", number_, std::strerror(errno));
        return std::nullopt;
    }
    return InputReading{((*levels & watched_->line.mask()) != 0) == watched_->active_level, asked_us};
}

std::string LineInputs::trouble() const {
    const std::lock_guard lock(mutex_);
    return trouble_;
}

} // namespace splinefeed::host
