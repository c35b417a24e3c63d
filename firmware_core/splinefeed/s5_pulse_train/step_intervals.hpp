// SPDX-License-Identifier: MIT
// StepIntervals: the engine for timers that count to an instant. Each axis's next step is solved ahead.
#pragma once

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/s5_pulse_train/axis_crossings.hpp"
#include "splinefeed/s5_pulse_train/step.hpp"

namespace splinefeed {

/// A StepEngine. Every step within a tick of its crossing (AxisCrossings). No drift: instants are counted from the
/// start of a segment, which is a sum of integers. Cost of next(): a comparison an axis, and one step solved.
class StepIntervals {
public:
    /// @param axes  1 to max_axes
    constexpr explicit StepIntervals(int axes) noexcept : axes_(static_cast<unsigned>(axes)) {}

    /// @pre next() has said false; AxisCrossings::begin's
    void take(const FeedSegment& segment) noexcept {
        SPLINEFEED_ASSERT(segment.duration_ticks > 0);
        start_ += duration_;
        duration_ = segment.duration_ticks;
        for (unsigned k = 0; k < axes_; ++k) {
            if (!started_) {
                axis_[k].stand(segment.start[k]);
            }
            axis_[k].begin(segment, k);
        }
        started_ = true;
    }

    /// Nothing is left: a segment's steps end with it.
    void finish() noexcept {}

    bool next(Step& out) noexcept {
        unsigned first = 0;
        std::uint32_t tick = axis_[0].tick();
        for (unsigned k = 1; k < axes_; ++k) {
            if (axis_[k].tick() < tick) {
                first = k;
                tick = axis_[k].tick();
            }
        }
        if (tick == AxisCrossings::none) {
            return false;
        }
        out.tick = start_ + tick;
        out.axis = static_cast<std::uint8_t>(first);
        out.up = axis_[first].up();
        axis_[first].advance();
        return true;
    }

    [[nodiscard]] std::int64_t now() const noexcept {
        std::uint32_t tick = duration_;
        for (unsigned k = 0; k < axes_; ++k) {
            tick = axis_[k].tick() < tick ? axis_[k].tick() : tick;
        }
        return start_ + tick;
    }

private:
    friend struct CounterSeam;

    PerAxis<AxisCrossings> axis_{};
    std::int64_t start_ = 0;     // of the segment [ticks]
    std::uint32_t duration_ = 0; // of the segment [ticks]
    unsigned axes_;
    bool started_ = false;
};

static_assert(StepEngine<StepIntervals>);

} // namespace splinefeed
