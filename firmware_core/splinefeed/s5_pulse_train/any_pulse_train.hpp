// SPDX-License-Identifier: MIT
// AnyPulseTrain: a pulse train whose engine is chosen at run time, from the machine. For hosts: firmware has one
// engine.
#pragma once

#include "splinefeed/s5_pulse_train/pulse_train.hpp"

#include <variant>

namespace splinefeed {

using AnyPulseTrain = std::variant<PulseTrain<StepIntervals>, PulseTrain<FixedRate>, PulseTrain<InterpolatedSteps>>;

/// If the timing has a grid, steps are at its ticks; otherwise each step is at its crossing, or between its ticks.
/// @pre as for StepDirSequencer
[[nodiscard]] inline AnyPulseTrain make_pulse_train(int axes, const StepTiming& timing) noexcept {
    const StepDirSequencer lines(axes, timing);
    if (timing.grid > 1) {
        return PulseTrain<FixedRate>(FixedRate(axes, timing.grid), lines);
    }
    if (timing.tick > 0) {
        return PulseTrain<InterpolatedSteps>(InterpolatedSteps(axes, timing.tick), lines);
    }
    return PulseTrain<StepIntervals>(StepIntervals(axes), lines);
}

} // namespace splinefeed
