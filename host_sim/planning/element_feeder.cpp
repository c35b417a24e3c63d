// SPDX-License-Identifier: MIT
#include "host_sim/planning/element_feeder.hpp"

#include "host_sim/planning/move_sources.hpp"

#include <algorithm>
#include <utility>

namespace splinefeed::host {

ElementFeeder::ElementFeeder(PathInput& input, PathSink& sink)
    : input_(&input), sink_(&sink), program_(move_source(input, input.scalar())) {}

// A move that turns a rotary axis keeps the smaller number: then the path is nowhere farther off, in mm and in degrees.
void ElementFeeder::limit_tolerance(SourceStep& step) const {
    const PathTolerances& tolerances = input_->tolerances();
    for (unsigned k = 0; k < max_axes; ++k) {
        const auto& points = step.move.bezier.points[k];
        const bool bends = step.move.shape == MoveShape::bezier &&
                           std::ranges::any_of(points, [](double offset) { return offset != 0.0; });
        if (tolerances.rotary[k] && (step.move.to[k] != here_[k] || bends)) {
            step.move.tolerance_mm = std::min(step.move.tolerance_mm, tolerances.rotary_deg);
        }
    }
}

// A move that is too short is none for the path: the machine cannot stand at its end, but at the end of the one before.
bool ElementFeeder::has_length(const SourceStep& step) const {
    const Result<bool> length = sink_->has_length(here_, step);
    if (!length.has_value()) {
        throw program_->refusal(step, describe(length.error()));
    }
    return *length;
}

void ElementFeeder::push(SourceStep& step, Pushed& pushed) {
    if (const Status status = sink_->push(step); !status.ok()) {
        throw program_->refusal(step, describe(status.error()));
    }
    program_->pushed(step);
    std::swap(pushed_, step);
    pushed.move = &pushed_;
    pushed.position = pushed_.move.to;
    ++moves_;
}

// Then its steps are due: the path does not leave the end of the move before it has the next one.
void ElementFeeder::push_held(Pushed& pushed) {
    holds_ = false;
    push(held_, pushed);
    due_ = behind_.size();
}

void ElementFeeder::take_due(Pushed& pushed) {
    step_ = std::move(behind_.front().step);
    pushed.row = behind_.front().row;
    pushed.step = &step_;
    behind_.pop_front();
    --due_;
}

// The next step of the program; false: it has ended.
bool ElementFeeder::take(Pushed& pushed) {
    if (due_ > 0) {
        take_due(pushed);
        return true;
    }
    if (!program_->next(step_)) {
        return false;
    }
    pushed.row = row_;
    pushed.short_rows = short_rows_;
    if (step_.kind == StepKind::nothing) {
        return true;
    }
    if (holds_ && (step_.stops || behind_.size() == most_behind)) {
        held_.move.stop_at_end = true;
    }
    if (step_.kind != StepKind::move) {
        if (!holds_) {
            pushed.step = &step_;
            return true;
        }
        behind_.push_back({std::move(step_), row_});
        if (held_.move.stop_at_end) {
            push_held(pushed);
            take_due(pushed);
        }
        return true;
    }
    limit_tolerance(step_);
    const bool moves = has_length(step_);
    if (program_->knows_stops()) {
        here_ = step_.move.to;
        push(step_, pushed);
        const std::uint32_t row = program_->row_of(moves_ - 1U);
        row_ = moves ? row : row_;
        short_rows_ = row_ ? row - *row_ : 0;
        return true;
    }
    if (!moves) {
        if (step_.move.stop_at_end && holds_) {
            held_.move.stop_at_end = true;
        }
        return true;
    }
    here_ = step_.move.to;
    if (holds_) {
        push_held(pushed);
    }
    std::swap(held_, step_);
    holds_ = true;
    row_ = program_->row_of(moves_); // of the move that waits
    return true;
}

bool ElementFeeder::release(Pushed& pushed) {
    pushed = {};
    if (!holds_ || due_ > 0) {
        return false;
    }
    held_.move.stop_at_end = true;
    push_held(pushed);
    return true;
}

void ElementFeeder::finish() {
    finished_ = true;
    if (const Status status = sink_->finish(); !status.ok()) {
        if (const std::string text = program_->without_moves(status.error()); !text.empty()) {
            throw InputError(input_->name(), 0, text);
        }
    }
}

bool ElementFeeder::more(Pushed& pushed) {
    pushed = {};
    if (finished_) {
        return false;
    }
    try {
        if (failure_ != nullptr && due_ == 0) {
            std::rethrow_exception(std::exchange(failure_, nullptr));
        }
        if (!started_) {
            started_ = program_->start(here_);
            if (!started_) {
                finish();
                return false;
            }
            if (const Status status = sink_->start(here_); !status.ok()) {
                throw program_->refusal(step_, describe(status.error()));
            }
            pushed.start = true;
            pushed.position = here_;
            return true;
        }
        if (take(pushed)) {
            return true;
        }
        if (holds_) {
            push_held(pushed);
            return true;
        }
        finish();
        return false;
    } catch (...) {
        if (holds_ && pushed.move == nullptr) { // the path ends with the move that waits
            failure_ = std::current_exception();
            push_held(pushed);
            return true;
        }
        if (!finished_) {
            finished_ = true;
            static_cast<void>(sink_->finish());
        }
        throw;
    }
}

} // namespace splinefeed::host
