// SPDX-License-Identifier: MIT
// LineInputs: digital inputs on lines of GPIO chips.
#pragma once

#include "host_sim/ports/gpio/program_chips.hpp"
#include "host_sim/ports/run_inputs.hpp"

#include "splinefeed/hal/rt/clock.hpp"

#include <mutex>

namespace splinefeed::host {

/// Each take() reads the line: a level that lasts for less than the time between two of them may be missed.
class LineInputs final : public RunInputs {
public:
    /// @param lines  must outlive it   @param chips  of these lines
    LineInputs(const ProgramLines& lines, ProgramChips chips, hal::Clock& clock = hal::system_clock())
        : lines_(&lines), chips_(std::move(chips)), clock_(&clock) {}

    [[nodiscard]] bool watch(std::int32_t number) override;
    void unwatch() override { watched_ = nullptr; }
    [[nodiscard]] std::optional<InputReading> take() override;
    [[nodiscard]] std::string trouble() const override;

private:
    const ProgramLines* lines_;
    ProgramChips chips_;
    hal::Clock* clock_;
    const SensedLine* watched_ = nullptr;
    std::int32_t number_ = 0;
    mutable std::mutex mutex_;
    std::string trouble_; // protected by it
};

} // namespace splinefeed::host
