// SPDX-License-Identifier: MIT
#include "host_sim/ports/program_outputs.hpp"

#include <algorithm>
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

void ProgramOutputs::act(const ProgramAction& action) {
    if (action.spindle && spindle_ != nullptr) {
        spindle_->order(action.spindle->direction, action.spindle->rpm);
    }
    if (RunSwitches::is_of(action.kind)) {
        for (const auto& switches : switches_) {
            switches->act(action.kind, action.number);
        }
    }
    if (action.kind == EventKind::input_wait) {
        ask(action);
    }
}

// What an operator switches meanwhile is no answer: only another question ends one.
void ProgramOutputs::ask(const ProgramAction& action) {
    end_question();
    for (const auto& inputs : inputs_) {
        if (inputs->watch(action.number)) {
            asked_ = inputs.get();
            question_.emplace(action.wait, action.value, clock_->now_us());
            asks_.store(true);
            return;
        }
    }
}

void ProgramOutputs::end_question() {
    if (question_) {
        asked_->unwatch();
        question_.reset();
        asks_.store(false);
    }
}

void ProgramOutputs::update() {
    if (spindle_ != nullptr) {
        spindle_->update();
    }
    if (!question_) {
        return;
    }
    const auto reading = asked_->take();
    const auto answer = reading ? question_->take(reading->active, reading->asked_us) : std::nullopt;
    if (answer) {
        answer_.store(*answer);
        end_question();
    }
}

void ProgramOutputs::end() {
    std::uint64_t not_yet = 0;
    ended_us_.compare_exchange_strong(not_yet, clock_->now_us());
    if (spindle_ != nullptr) {
        spindle_->end();
    }
    for (const auto& switches : switches_) {
        switches->end();
    }
}

std::string ProgramOutputs::trouble() const {
    std::string what = spindle_ != nullptr ? spindle_->trouble() : std::string();
    for (const auto& switches : switches_) {
        what = what.empty() ? switches->trouble() : what;
    }
    for (const auto& inputs : inputs_) {
        what = what.empty() ? inputs->trouble() : what;
    }
    return what;
}

std::string ProgramOutputs::unconfirmed() const {
    std::string what;
    for (const auto& switches : switches_) {
        const std::string line = switches->unconfirmed();
        what += line.empty() ? "" : (what.empty() ? "" : "; ") + line + " did not confirm its last level";
    }
    return what;
}

std::string ProgramOutputs::unended() const {
    const std::string lines = unconfirmed();
    return spindle_stands()
               ? lines
               : "the spindle did not confirm that it stands and may still turn" + (lines.empty() ? "" : "; " + lines);
}

bool ProgramOutputs::ends() const {
    constexpr double switches_s = 1.0;
    const double passed_s = 1e-6 * static_cast<double>(clock_->now_us() - ended_us_.load());
    return (!spindle_stands() && passed_s < spindle_->stop_timeout_s()) ||
           (passed_s < switches_s && !unconfirmed().empty());
}

} // namespace splinefeed::host
