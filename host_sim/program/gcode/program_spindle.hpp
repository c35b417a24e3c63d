// SPDX-License-Identifier: MIT
// ProgramSpindle: how the spindle turns where a program has been read to.
#pragma once

#include "host_sim/config/spindle_description.hpp"
#include "host_sim/program/program_action.hpp"

#include <optional>
#include <string>

namespace splinefeed::host {

class ProgramSpindle {
public:
    /// @param kind  of an event of the spindle   @param rpm  its S   @param machine  the spindle; must outlive it
    /// Returns why the machine cannot do this; empty: it can. S alone changes a spindle that was
    /// switched on, and so does the speed that G96 follows to, for which nothing waits. With S0 it stands, as in
    /// LinuxCNC: it is still switched on, and turns with the next S above 0.
    [[nodiscard]] std::string take(EventKind kind, double rpm, const SpindleDescription& machine);

    /// What the last event asks for; nothing: nothing that the spindle has to wait for.
    [[nodiscard]] const std::optional<SpindleTurn>& turn() const noexcept { return turn_; }
    /// How long that takes in the simulated machine.
    [[nodiscard]] double change_s() const noexcept { return change_s_; }

    /// Whether an event is one of the spindle.
    [[nodiscard]] static bool is_of(EventKind kind) noexcept;

private:
    int direction_ = 0; // as it was switched on: 1, -1; 0: off
    double signed_rpm_ = 0.0;
    std::optional<SpindleTurn> turn_;
    double change_s_ = 0.0;
};

} // namespace splinefeed::host
