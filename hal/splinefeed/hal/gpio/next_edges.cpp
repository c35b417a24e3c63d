// SPDX-License-Identifier: MIT
#include "splinefeed/hal/gpio/next_edges.hpp"

#include <variant>

namespace splinefeed::hal::gpio {

namespace {

constexpr std::size_t ring_segments = 4096;

} // namespace

NextEdges::NextEdges(int axes, const StepTiming& timing)
    : axes_(axes), timing_(timing), train_(make_pulse_train(axes, timing)), segments_(ring_segments), ring_(segments_) {
}

void NextEdges::reset() noexcept {
    train_ = make_pulse_train(axes_, timing_);
    ring_.clear();
    current_ = {};
    have_ = gathered_ = finished_ = false;
}

bool NextEdges::push(const FeedSegment& segment) noexcept {
    if (ring_.room() == 0) {
        return false;
    }
    ring_.push(segment);
    return true;
}

// The next edge of the motion; false: none yet.
bool NextEdges::next(bool complete) noexcept {
    const auto next_of = [&](auto& train) {
        while (!train.next(edge_)) {
            if (ring_.pop(current_)) {
                train.take(current_);
                taken_.fetch_add(1, std::memory_order_relaxed);
            } else if (complete && !finished_) {
                train.finish();
                finished_ = true;
            } else {
                return false;
            }
        }
        return true;
    };
    if (auto* const intervals = std::get_if<PulseTrain<StepIntervals>>(&train_)) {
        return next_of(*intervals);
    }
    auto* const fixed = std::get_if<PulseTrain<FixedRate>>(&train_);
    return fixed != nullptr ? next_of(*fixed) : next_of(*std::get_if<PulseTrain<InterpolatedSteps>>(&train_));
}

bool NextEdges::gather(PinChanges& lines, bool complete) noexcept {
    if (gathered_) {
        return true;
    }
    if (!have_ && !(have_ = next(complete))) {
        return false;
    }
    gathered_ = true;
    tick_ = edge_.tick;
    stepped_ = {};
    do {
        lines.add(edge_);
        const bool steps = edge_.line == Line::step && (edge_.level || timing_.step_on_edge);
        stepped_[edge_.axis] = stepped_[edge_.axis] || steps;
    } while ((have_ = next(complete)) && edge_.tick == tick_);
    return true;
}

} // namespace splinefeed::hal::gpio
