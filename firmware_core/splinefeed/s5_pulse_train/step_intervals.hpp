// SPDX-License-Identifier: MIT
// StepIntervals: the step engine for timers that fire at a given instant. The next step of each axis is computed ahead.
#pragma once

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/s5_pulse_train/axis_crossings.hpp"
#include "splinefeed/s5_pulse_train/step.hpp"

namespace splinefeed {

/// A StepEngine. Every step is within a tick of its crossing (AxisCrossings). It does not drift: instants are counted
/// from the start of a segment, which is a sum of integers. Cost of next(): one comparison per axis, and one step to
/// solve.
class StepIntervals {
public:
    /// @param axes  1 to max_axes
    constexpr explicit StepIntervals(int axes) noexcept : axes_(static_cast<unsigned>(axes)) {}

    /// @pre next() has returned false; as for AxisCrossings::begin
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

    /// There are no further steps: the steps of a segment end with it.
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
