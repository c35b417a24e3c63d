// SPDX-License-Identifier: MIT
#include "host_sim/planning/element_feeder.hpp"

#include "host_sim/planning/move_sources.hpp"

#include "splinefeed/s1_blended_path/element_cast.hpp"

#include <algorithm>

namespace splinefeed::host {

ElementFeeder::ElementFeeder(PathInput& input, MoveStream& stream)
    : input_(&input), stream_(&stream), program_(move_source(input, input.scalar())) {}

// A move that turns a rotary axis keeps the smaller number: then the path is nowhere farther off, in mm and in degrees.
void ElementFeeder::limit_tolerance(SourceStep& step) const {
    const PathTolerances& tolerances = input_->tolerances();
    for (unsigned k = 0; k < max_axes; ++k) {
        const auto& points = step.move.bezier.points[k];
        const bool bends = step.move.shape == MoveShape::bezier &&
                           std::ranges::any_of(points, [](double offset) { return offset != 0.0; });
        if (tolerances.rotary[k] && (step.move.to[k] != stream_->end()[k] || bends)) {
            step.move.tolerance_mm = std::min(step.move.tolerance_mm, tolerances.rotary_deg);
        }
    }
}

// A move that is too short is none: the machine cannot stand at its end, but at the end of the one before.
void ElementFeeder::take_move(Pushed& pushed) {
    limit_tolerance(step_);
    const auto push = [this] {
        if (step_.exact_points) {
            auto exact = element_cast<Fixed>(step_.move);
            exact.bezier = *step_.exact_points;
            return stream_->push(exact);
        }
        return stream_->push(step_.move);
    };
    const Result<bool> taken = push();
    if (!taken.has_value()) {
        throw program_->refusal(step_, describe(taken.error()));
    }
    if (*taken) {
        program_->pushed(step_);
        pushed.move = &step_;
        pushed.position = step_.move.to;
    } else {
        pushed.stops = pushed.stops || step_.move.stop_at_end;
    }
}

// The next step of the program; false: it has ended.
bool ElementFeeder::take(Pushed& pushed) {
    if (!program_->next(step_)) {
        return false;
    }
    if (step_.kind == StepKind::nothing) {
        return true;
    }
    const bool moves = step_.kind == StepKind::move;
    behind_ = moves || step_.stops ? 0 : behind_ % most_behind + 1;
    pushed.stops = step_.stops || behind_ == most_behind;
    if (pushed.stops && !(moves || !step_.stops ? stream_->rest() : stream_->stop())) {
        throw program_->refusal(step_, describe(Error::no_room));
    }
    if (moves) {
        take_move(pushed);
    } else {
        pushed.step = &step_;
        pushed.moves = stream_->moves();
    }
    return true;
}

void ElementFeeder::finish() {
    finished_ = true;
    if (const Status status = stream_->finish(); !status.ok()) {
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
        if (started_ && take(pushed)) {
            return true;
        }
        if (started_ || !program_->start(pushed.position)) {
            finish();
            return false;
        }
        if (const Status status = stream_->place(pushed.position); !status.ok()) {
            throw program_->refusal(step_, describe(status.error()));
        }
        started_ = pushed.start = true;
        return true;
    } catch (...) {
        if (!finished_) { // the path ends with what came before
            finished_ = true;
            static_cast<void>(stream_->finish());
        }
        throw;
    }
}

} // namespace splinefeed::host
