// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/setpoint/command_sequence.hpp"

#include "splinefeed/base/units.hpp"

namespace splinefeed::hal::modbus {

bool CommandSequence::begin(DriveCommand command) noexcept {
    const std::vector<CommandStep>& steps = profile_.steps_of(command);
    steps_ = steps.empty() ? nullptr : &steps;
    step_ = 0;
    second_ = false;
    due_us_ = 0;
    if (steps_ != nullptr) {
        prepare();
    }
    return steps_ != nullptr;
}

bool CommandSequence::two_frames() const noexcept {
    const StepKind kind = (*steps_)[step_].kind;
    return kind == StepKind::edge || kind == StepKind::pulse;
}

void CommandSequence::prepare() noexcept {
    const CommandStep& step = (*steps_)[step_];
    const std::int64_t mask = step.mask;
    const std::int64_t bits = step.value;
    const std::int64_t last = frames_.last(step.field);
    const bool cleared = two_frames() && (step.kind == StepKind::edge) != second_;
    const std::int64_t raw = step.kind == StepKind::toggle ? last ^ mask : (last & ~mask) | (cleared ? 0 : bits);
    write_ = frames_.single(step.field, raw);
}

void CommandSequence::on_sent(std::uint64_t now_us) noexcept {
    const CommandStep& step = (*steps_)[step_];
    const bool first_of_two = two_frames() && !second_;
    // The duration of a pulse is between its frames; other durations follow the last frame.
    const bool waits = step.kind == StepKind::pulse ? first_of_two : !first_of_two;
    due_us_ = now_us + (waits ? us_per_ms * step.duration_ms : 0);
    second_ = first_of_two;
    step_ += first_of_two ? 0 : 1;
    if (step_ == steps_->size()) {
        steps_ = nullptr;
    } else {
        prepare();
    }
}

} // namespace splinefeed::hal::modbus
