// SPDX-License-Identifier: MIT
// StepDirSequencer: turns steps into edges of step and direction lines, in order of time.
#pragma once

#include "splinefeed/base/capacity.hpp"
#include "splinefeed/s5_pulse_train/edge.hpp"
#include "splinefeed/s5_pulse_train/step.hpp"
#include "splinefeed/s5_pulse_train/step_timing.hpp"

#include <array>
#include <cstdint>

namespace splinefeed {

/// It never moves a step. If a step and the step back are closer than turn_gap(), it makes neither. Memory: constant,
/// 32 steps per axis. Cost of next(): a look at each axis.
class StepDirSequencer {
public:
    /// @pre 1 <= axes <= max_axes; timing.allows() the motion of the axes
    constexpr StepDirSequencer(int axes, const StepTiming& timing) noexcept
        : timing_(timing), axes_(static_cast<unsigned>(axes)) {}

    /// @pre the step is not earlier than any step before; next() has returned false since the last push()
    void push(const Step& step) noexcept;
    /// Writes the next edge that no later step can precede. false: more steps must be known first.
    /// @param known  no step before this instant will come; the largest std::int64_t: no step will come at all
    bool next(Edge& out, std::int64_t known) noexcept;

    /// Number of steps that were left out: two at each reversal that barely touched a crossing.
    [[nodiscard]] std::uint64_t left_out() const noexcept { return left_out_; }

private:
    static constexpr unsigned capacity = 32;

    struct Waiting {
        std::int64_t tick = 0;
        bool up = false;
    };
    /// One axis: the state of its lines, and the steps that are still to be made.
    struct Lane {
        std::array<Waiting, capacity> step{};
        unsigned head = 0;
        unsigned size = 0;
        std::int64_t fall = 0; // end of the pulse that is on
        bool on = false;
        bool level = false; // used with step_on_edge
        bool up = false;
    };

    [[nodiscard]] std::int64_t due(const Lane& lane) const noexcept;
    void pass(Lane& lane, Edge& out) const noexcept;

    PerAxis<Lane> lane_{};
    StepTiming timing_;
    std::uint64_t left_out_ = 0;
    unsigned axes_;
};

} // namespace splinefeed
