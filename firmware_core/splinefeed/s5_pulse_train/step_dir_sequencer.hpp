// SPDX-License-Identifier: MIT
// StepDirSequencer: steps to edges of step and direction lines, in order of time.
#pragma once

#include "splinefeed/base/capacity.hpp"
#include "splinefeed/s5_pulse_train/edge.hpp"
#include "splinefeed/s5_pulse_train/step.hpp"
#include "splinefeed/s5_pulse_train/step_timing.hpp"

#include <array>
#include <cstdint>

namespace splinefeed {

/// No step is ever moved. Of a step and one back closer than turn_gap() neither is made. Memory: constant, 32 steps an
/// axis. Cost of next(): a look at each axis.
class StepDirSequencer {
public:
    /// @pre 1 <= axes <= max_axes; timing.allows() what the axes do
    constexpr StepDirSequencer(int axes, const StepTiming& timing) noexcept
        : timing_(timing), axes_(static_cast<unsigned>(axes)) {}

    /// @pre not earlier than any step before; next() has said false since the step before
    void push(const Step& step) noexcept;
    /// The next edge that no later step can precede. False: more steps must be known first.
    /// @param known  no step before this instant is still to come; std::int64_t's largest: none is
    bool next(Edge& out, std::int64_t known) noexcept;

    /// Steps that were left out, two at each reversal that barely touched a crossing.
    [[nodiscard]] std::uint64_t left_out() const noexcept { return left_out_; }

private:
    static constexpr unsigned capacity = 32;

    struct Waiting {
        std::int64_t tick = 0;
        bool up = false;
    };
    /// One axis: its lines as they are, and the steps that are still to be made.
    struct Lane {
        std::array<Waiting, capacity> step{};
        unsigned head = 0;
        unsigned size = 0;
        std::int64_t fall = 0; // of the pulse that is on
        bool on = false;
        bool level = false; // with step_on_edge
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
