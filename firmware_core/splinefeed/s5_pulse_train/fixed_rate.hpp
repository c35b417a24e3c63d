// SPDX-License-Identifier: MIT
// FixedRate: the step engine for a timer interrupt at a fixed rate, on a virtual clock.
#pragma once

#include "splinefeed/s5_pulse_train/dda_loader.hpp"
#include "splinefeed/s5_pulse_train/step.hpp"
#include "splinefeed/s5_pulse_train/tick_dda.hpp"

#include <bit>

namespace splinefeed {

/// A StepEngine made of DdaLoader and TickDda. Every step is at the tick nearest to its crossing. A microcontroller
/// uses the two classes directly: the loader in its main loop, the DDA in the interrupt.
class FixedRate {
public:
    /// Parameters as for DdaLoader and TickDda.
    constexpr FixedRate(int axes, std::uint32_t tick_ticks) noexcept
        : parts_(axes, tick_ticks), tick_ticks_(tick_ticks) {}

    void take(const FeedSegment& segment) noexcept {
        parts_.take(segment);
        if (!started_) {
            dda_.stand(parts_.start_count());
        }
        started_ = true;
    }

    /// Adds the step of a crossing in the last half tick of all motion.
    void finish() noexcept {
        if (started_) {
            steps_ = dda_.finish(parts_.end_count());
            ++passed_;
        }
    }

    bool next(Step& out) noexcept {
        while (steps_.bits == 0) {
            if (dda_.left() > 0) {
                steps_ = dda_.tick();
            } else if (TickPart part; parts_.next(part)) {
                steps_ = dda_.begin(part);
            } else {
                return false;
            }
            ++passed_;
        }
        const unsigned axis = static_cast<unsigned>(std::countr_zero(steps_.bits)) / 2;
        out.tick = (passed_ - 1) * tick_ticks_;
        out.axis = static_cast<std::uint8_t>(axis);
        out.up = steps_.up(axis);
        steps_.bits &= ~(3U << (2 * axis));
        return true;
    }

    [[nodiscard]] std::int64_t now() const noexcept { return (passed_ - (steps_.bits != 0 ? 1 : 0)) * tick_ticks_; }

private:
    friend struct CounterSeam;

    DdaLoader parts_;
    TickDda<static_cast<unsigned>(max_axes)> dda_{};
    StepBits steps_{};        // steps of the last tick that are not delivered yet
    std::int64_t passed_ = 0; // ticks; the first one is at the start of the motion
    std::uint32_t tick_ticks_;
    bool started_ = false;
};

static_assert(StepEngine<FixedRate>);

} // namespace splinefeed
