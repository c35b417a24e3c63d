// SPDX-License-Identifier: MIT
// GpioSwitches: coolant and digital outputs on lines of GPIO chips.
#pragma once

#include "host_sim/ports/gpio/program_chips.hpp"
#include "host_sim/ports/run_switches.hpp"
#include "host_sim/ports/switch_turns.hpp"

#include <mutex>

namespace splinefeed::host {

class GpioSwitches final : public RunSwitches {
public:
    /// @param lines  must outlive it   @param chips  of these lines, which are as they are safe
    GpioSwitches(const ProgramLines& lines, ProgramChips chips) : lines_(&lines), chips_(std::move(chips)) {}
    ~GpioSwitches() override { GpioSwitches::end(); }

    void act(EventKind kind, std::int32_t number) override;
    void end() noexcept override;
    [[nodiscard]] std::string trouble() const override;
    [[nodiscard]] std::string unconfirmed() const override;

private:
    /// Returns the line that cannot be set; empty: it is set, or another's.
    std::string turn(const SwitchTurn& turn);

    const ProgramLines* lines_;
    ProgramChips chips_;
    mutable std::mutex mutex_;
    bool ended_ = false;
    std::string trouble_;
    std::string unset_; // the first line that end() could not set
};

} // namespace splinefeed::host
