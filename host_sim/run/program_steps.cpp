// SPDX-License-Identifier: MIT
#include "host_sim/run/program_steps.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/standard_streams.hpp"
#include "host_sim/ports/program_outputs.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace splinefeed::host {

namespace {

// As SegmentStream makes control points: from 2^-40 mm times Q32.32 counts per mm to multiples of 6 units.
constexpr int control_shift = Position::fraction_bits + 32 - 29;
constexpr int units_per_control = 6;

} // namespace

// The first step if the motion has come to it.
const PendingStep* ProgramSteps::due() const noexcept {
    if (pending_.empty()) {
        return nullptr;
    }
    const PendingStep& first = pending_.front();
    return (first.stops ? stream_->stands() : stream_->passed(first.moves)) ? &first : nullptr;
}

void ProgramSteps::add(const PathFeeder::Pushed& pushed) {
    if (pushed.start) {
        start_ = pushed.position;
    }
    if (pushed.step == nullptr) {
        return;
    }
    const SourceStep& step = *pushed.step;
    const bool dwells = step.kind == StepKind::dwell;
    if (dwells) {
        ++summary_.dwells;
        summary_.dwell_s += step.dwell_s;
    }
    pending_.push_back({step.kind, step.stops, step.dwell_s, step.line, step.action, step.offsets, pushed.moves});
}

void ProgramSteps::happen(double time_s) {
    const PendingStep step = std::move(pending_.front());
    pending_.pop_front();
    left_ticks_ = 0;
    if (step.stops) {
        stream_->go_on();
    }
    if (step.kind != StepKind::event) {
        return;
    }
    const ProgramAction& action = step.action;
    if (live_->is_real() && action.kind == EventKind::input_wait) {
        answer_ = live_->input();
    }
    if (!action.spindle && ProgramOutputs::is_of(action)) {
        live_->order(action, false);
    }
    if (step.offsets != nullptr) {
        offsets_ = step.offsets;
        offsets_changed_ = true;
    }
    const ProgramSummary::Event event{time_s,        step.line,    action_name(action.kind),
                                      action.number, action.value, action.text};
    if (record_ != nullptr) {
        record_->happened(event, action.kind);
    }
    if (summary_.events++ < ProgramSummary::most_events) {
        summary_.first_events.push_back(event);
    }
    const bool said =
        action.kind == EventKind::message || action.kind == EventKind::print || action.kind == EventKind::debug;
    if (tells_ && said) {
        tell("{}\n", printable(action.text));
    }
}

void ProgramSteps::begin(double time_s) {
    moved_ = true;
    for (const PendingStep* step = due(); step != nullptr && !step->stops; step = due()) {
        happen(time_s);
    }
}

// The machine stands until it has come to the step's place, the spindle turns as the step says, the input has answered,
// and the user wants to go on.
bool ProgramSteps::waits_for_order(const PendingStep& step) {
    const bool asks = host::waits_for_user(step.action.kind);
    const bool reads = step.action.kind == EventKind::input_wait;
    if (!live_->is_real() || !(step.action.spindle || asks || reads)) {
        return false;
    }
    if (!ordered_) {
        live_->order(step.action, true);
        ordered_ = true;
        asked_ = Asked::no;
    }
    return !live_->carried_out() || (asks && waits_for_user(step));
}

// Nobody shall reach for a tool that turns.
bool ProgramSteps::waits_for_user(const PendingStep& step) {
    const ProgramAction& action = step.action;
    const bool tool = action.kind == EventKind::tool_change;
    const std::string what = tool ? fmt::format("line {}: M6, change to tool {}", step.line, action.number)
                                  : fmt::format("line {}: {}", step.line,
                                                action.kind == EventKind::pause            ? "M0"
                                                : action.kind == EventKind::optional_pause ? "M1"
                                                                                           : "M60");
    if (asked_ != Asked::user && tool && !live_->spindle_stands()) {
        if (asked_ == Asked::no) {
            tell("splinefeed: {}: wait until the spindle stands\n", what);
            asked_ = Asked::spindle;
        }
        return true;
    }
    if (asked_ != Asked::user) {
        pause_.ask(what);
        asked_ = Asked::user;
    }
    return !pause_.answered();
}

bool ProgramSteps::stands(double time_s) {
    while (const PendingStep* const step = due()) {
        if (left_ticks_ > 0) {
            return true;
        }
        if (waits_for_order(*step)) {
            return true;
        }
        if (std::exchange(ordered_, false)) {
            happen(time_s);
            continue;
        }
        left_ticks_ = static_cast<std::uint64_t>(std::llround(step->dwell_s * ticks_per_us * 1e6));
        began_s_ = time_s;
        if (left_ticks_ == 0) {
            happen(time_s);
        }
    }
    return false;
}

void ProgramSteps::stood(const FeedSegment& segment) {
    if (ordered_) {
        return;
    }
    left_ticks_ -= std::min<std::uint64_t>(left_ticks_, segment.duration_ticks);
    if (left_ticks_ == 0) {
        happen(began_s_);
    }
}

void ProgramSteps::at_start(FeedSegment& segment) const noexcept {
    segment = {};
    segment.duration_ticks = figures_->segment_ticks;
    for (const unsigned k : indices(figures_->axes)) {
        segment.start[k] = units_per_control * scaled(start_[k], figures_->steps_per_mm_q32[k], control_shift);
        segment.end[k] = segment.start[k];
    }
}

} // namespace splinefeed::host
