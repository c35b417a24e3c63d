// SPDX-License-Identifier: MIT
// InterpolatedSteps: the step engine for lines that a coprocessor switches, such as an RP2040's PIO. Steps lie between
// ticks, where the line through the positions at both crosses.
#pragma once

#include "splinefeed/s5_pulse_train/dda_loader.hpp"
#include "splinefeed/s5_pulse_train/sample_dda.hpp"
#include "splinefeed/s5_pulse_train/step.hpp"

namespace splinefeed {

/// A StepEngine made of DdaLoader and SampleDda, as FixedRate is made of DdaLoader and TickDda. Between two ticks, h
/// apart, the plan is taken for straight. It is off that line by at most a h^2 / 8 with the acceleration a: 2^-12 count
/// with 40 us and 10^6 counts/s^2. Each step is within 1/8 us of a crossing of a plan that is shifted by so much.
class InterpolatedSteps {
public:
    static constexpr std::uint32_t most_counts = 7; ///< that an axis travels in a tick

    /// Parameters as for DdaLoader.
    constexpr InterpolatedSteps(int axes, std::uint32_t tick_ticks) noexcept
        : parts_(axes, tick_ticks, DdaLoader::Samples::at_ticks), dda_(tick_ticks),
          start_(-2 * static_cast<std::int64_t>(tick_ticks)), tick_ticks_(tick_ticks) {}

    void take(const FeedSegment& segment) noexcept {
        parts_.take(segment);
        if (!started_) {
            dda_.stand(parts_.start_count());
        }
        started_ = true;
    }

    /// Adds the steps behind the last tick of all motion.
    void finish() noexcept {
        if (started_) {
            steps_ = *dda_.finish(parts_.end_count());
            start_ += tick_ticks_;
        }
    }

    bool next(Step& out) noexcept {
        unsigned axis = first();
        while (axis == none) {
            if (dda_.left() > 0) {
                steps_ = *dda_.tick();
            } else if (TickPart part; parts_.next(part)) {
                steps_ = *dda_.begin(part);
            } else {
                return false;
            }
            start_ += tick_ticks_;
            axis = first();
        }
        out.tick = start_ + steps_[axis].instant();
        out.axis = static_cast<std::uint8_t>(axis);
        out.up = steps_[axis].up;
        steps_[axis].advance();
        return true;
    }

    [[nodiscard]] std::int64_t now() const noexcept {
        const unsigned axis = first();
        return axis != none ? start_ + steps_[axis].instant() : start_ + tick_ticks_;
    }

private:
    friend struct CounterSeam;
    using Dda = SampleDda<static_cast<unsigned>(max_axes)>;
    static constexpr unsigned none = static_cast<unsigned>(max_axes);

    /// The axis that steps next.
    [[nodiscard]] unsigned first() const noexcept {
        unsigned axis = none;
        for (unsigned k = 0; k < steps_.size(); ++k) {
            const bool sooner = axis == none || steps_[k].instant() < steps_[axis].instant();
            axis = steps_[k].count > 0 && sooner ? k : axis;
        }
        return axis;
    }

    DdaLoader parts_;
    Dda dda_;
    PerAxis<LineSteps> steps_{}; // between two ticks, those that are not delivered yet
    std::int64_t start_; // the first of the two; the sample at the start of all motion is the second of no steps
    std::uint32_t tick_ticks_;
    bool started_ = false;
};

static_assert(StepEngine<InterpolatedSteps>);

} // namespace splinefeed
