// SPDX-License-Identifier: MIT
// StepShaper: turns the steps of the DDA into levels of step and direction lines, a tick at a time.
#pragma once

#include "splinefeed/s5_pulse_train/tick_dda.hpp"

#include <cstdint>

namespace firmware {

/// What the lines of all axes show during one tick; bit k is axis k.
struct Pins {
    std::uint32_t step = 0;
    std::uint32_t up = 0;
};

/// Everything takes one tick: the pulse, the pause after it, the direction before a step (set-up) and after a pulse
/// (hold). Steps come out `delay` ticks late. A step and the step back that are closer than three ticks leave no time
/// to turn the direction: neither is made, and the axis stands where it would have stood. These are the edges of
/// splinefeed::StepDirSequencer with all four times at one tick (tests/firmware compares them), without its buffers.
/// @tparam Axes  1 to 6
template <unsigned Axes>
class StepShaper {
public:
    static constexpr unsigned delay = 3;

    /// @param steps  of this tick; nothing steps in two successive ticks in the same direction
    Pins next(splinefeed::StepBits steps) noexcept {
        Steps now;
        for (unsigned k = 0; k < Axes; ++k) {
            now.step |= ((steps.bits >> (2 * k)) & 1U) << k;
            now.down |= ((steps.bits >> (2 * k + 1)) & 1U) << k;
        }
        leave_out(now, first_);
        leave_out(now, second_);
        const Steps out = third_;
        third_ = second_;
        second_ = first_;
        first_ = now;
        // third_ is certain now, and its pulse begins in the next tick.
        up_ = (up_ & ~third_.step) | (third_.step & ~third_.down);
        return {out.step, up_};
    }

    /// Forgets the steps that are under way; the directions stay.
    void clear() noexcept { first_ = second_ = third_ = {}; }
    [[nodiscard]] bool empty() const noexcept { return (first_.step | second_.step | third_.step) == 0; }

private:
    struct Steps {
        std::uint32_t step = 0;
        std::uint32_t down = 0;
    };

    static void leave_out(Steps& now, Steps& before) noexcept {
        const std::uint32_t turned = now.step & before.step & (now.down ^ before.down);
        now.step &= ~turned;
        before.step &= ~turned;
    }

    Steps first_;  // steps of the tick before
    Steps second_; // of two ticks before
    Steps third_;
    std::uint32_t up_ = 0;
};

} // namespace firmware
