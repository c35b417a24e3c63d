// SPDX-License-Identifier: MIT
// AnyPulseTrain: a pulse train whose engine is chosen when the machine is known. For hosts: firmware has one engine.
#pragma once

#include "splinefeed/s5_pulse_train/pulse_train.hpp"

#include <variant>

namespace splinefeed {

using AnyPulseTrain = std::variant<PulseTrain<StepIntervals>, PulseTrain<FixedRate>>;

/// Steps at the ticks of the timing's grid, where it has one; else each at its crossing.
/// @pre as StepDirSequencer
[[nodiscard]] inline AnyPulseTrain make_pulse_train(int axes, const StepTiming& timing) noexcept {
    const StepDirSequencer lines(axes, timing);
    if (timing.grid > 1) {
        return PulseTrain<FixedRate>(FixedRate(axes, timing.grid), lines);
    }
    return PulseTrain<StepIntervals>(StepIntervals(axes), lines);
}

} // namespace splinefeed
