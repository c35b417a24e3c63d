// SPDX-License-Identifier: MIT
// PulseTrain: turns feed segments into edges of step and direction lines, with any of the engines. It uses integers
// only and does not allocate.
#pragma once

#include "splinefeed/s5_pulse_train/fixed_rate.hpp"
#include "splinefeed/s5_pulse_train/interpolated_steps.hpp"
#include "splinefeed/s5_pulse_train/step_dir_sequencer.hpp"
#include "splinefeed/s5_pulse_train/step_intervals.hpp"

#include <limits>

namespace splinefeed {

/// Use: train.take(segment); while (train.next(edge)) {...}; at the end of all motion train.finish(), and the loop once
/// more. An edge is delivered as soon as no later step can come before it. The motion must be known beyond it by
/// the set-up time, and beyond a step also by turn_gap(), or up to the next step of its axis.
template <StepEngine Engine>
class PulseTrain {
public:
    /// @pre as for Engine and StepDirSequencer
    constexpr PulseTrain(const Engine& engine, const StepDirSequencer& lines) noexcept
        : engine_(engine), lines_(lines) {}

    /// @pre next() has returned false
    void take(const FeedSegment& segment) noexcept {
        engine_.take(segment);
        known_ = engine_.now();
    }
    void finish() noexcept {
        engine_.finish();
        finished_ = true;
    }

    /// The next edge, in order of time. false: a segment is needed, or after finish() there are no more edges.
    bool next(Edge& out) noexcept {
        for (;;) {
            if (lines_.next(out, known_)) {
                return true;
            }
            if (Step step; engine_.next(step)) {
                lines_.push(step);
                known_ = step.tick;
                continue;
            }
            const std::int64_t now = finished_ ? std::numeric_limits<std::int64_t>::max() : engine_.now();
            if (now == known_) {
                return false;
            }
            known_ = now;
        }
    }

    [[nodiscard]] const StepDirSequencer& lines() const noexcept { return lines_; }

private:
    Engine engine_;
    StepDirSequencer lines_;
    std::int64_t known_ = 0;
    bool finished_ = false;
};

} // namespace splinefeed
