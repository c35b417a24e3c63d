// SPDX-License-Identifier: MIT
// switch_turns: what an event turns on or off of the lines and coils of a machine.
#pragma once

#include "host_sim/config/program_pins.hpp"

#include "splinefeed/s0_program/words/program_event.hpp"

#include <vector>

namespace splinefeed::host {

struct SwitchTurn {
    const ProgramSwitch* line = nullptr; ///< of the ProgramPins
    bool on = false;
};

/// What M7 to M9 and M62 to M65 turn; nothing for other events. `lines` must outlive the result. @param number  of the
/// output
[[nodiscard]] std::vector<SwitchTurn> switch_turns(const ProgramPins& lines, EventKind kind, std::int32_t number);

/// Everything, as it is safe: coolant off, outputs as the machine file has it.
[[nodiscard]] std::vector<SwitchTurn> safe_turns(const ProgramPins& lines);

} // namespace splinefeed::host
