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

bool ProgramOutputs::is_of(const ProgramAction& action) noexcept {
    return is_coolant(action.kind) || is_output(action.kind) || action.spindle.has_value();
}

// What an operator switches meanwhile is no answer: only another question ends one.
void ProgramOutputs::act(const ProgramAction& action) {
    if (action.kind == EventKind::input_wait) {
        question_.reset();
        asks_.store(action.number >= 0);
        if (action.number >= 0) {
            question_.emplace(action.wait, action.value, clock_->now_us());
        }
    }
    for (const auto& part : parts_) {
        part->act(action);
    }
}

void ProgramOutputs::update() {
    std::optional<InputReading> reading;
    for (const auto& part : parts_) {
        part->update();
        reading = reading ? reading : part->take();
    }
    const auto answer = question_ && reading ? question_->take(reading->active, reading->asked_us) : std::nullopt;
    if (answer) {
        answer_.store(*answer);
        act({.kind = EventKind::input_wait, .number = none, .text = {}});
    }
}

void ProgramOutputs::end() {
    std::uint64_t not_yet = 0;
    ended_us_.compare_exchange_strong(not_yet, clock_->now_us());
    for (const auto& part : parts_) {
        part->end();
    }
}

// Of the spindle: one part has it.
OutputPart::Progress ProgramOutputs::progress() const {
    OutputPart::Progress out;
    for (const auto& part : parts_) {
        const OutputPart::Progress of = part->progress();
        out.carried_out = out.carried_out && of.carried_out;
        out.stands = out.stands && of.stands;
        out.stop_timeout_s = std::max(out.stop_timeout_s, of.stop_timeout_s);
        out.coasts_s = std::max(out.coasts_s, of.coasts_s);
    }
    return out;
}

std::uint64_t ProgramOutputs::coasts_us() const {
    const OutputPart::Progress spindle = progress();
    return spindle.stands ? 0 : static_cast<std::uint64_t>(std::llround(spindle.coasts_s * 1e6));
}

std::string ProgramOutputs::trouble() const {
    std::string what;
    for (const auto& part : parts_) {
        what = what.empty() ? part->trouble() : what;
    }
    return what;
}

std::string ProgramOutputs::unconfirmed() const {
    std::string what;
    for (const auto& part : parts_) {
        const std::string line = part->unconfirmed();
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
    const OutputPart::Progress spindle = progress();
    return (!spindle.stands && passed_s < spindle.stop_timeout_s) || (passed_s < switches_s && !unconfirmed().empty());
}

} // namespace splinefeed::host
