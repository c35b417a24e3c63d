// SPDX-License-Identifier: MIT
// ProgramAction: what a program asks for besides motion.
#pragma once

#include "splinefeed/s0_program/words/program_event.hpp"

#include <optional>
#include <string>

namespace splinefeed::host {

/// How a spindle is to turn.
struct SpindleTurn {
    int direction = 0; ///< 1 clockwise, -1 counterclockwise, 0 not at all
    double rpm = 0.0;
};

/// An event with its own copy of the text.
struct ProgramAction {
    EventKind kind = EventKind::message;
    std::int32_t number = 0;
    double value = 0.0;
    std::string text;
    std::optional<SpindleTurn> spindle{}; ///< the motion waits until a real spindle turns like this
    InputWait wait = InputWait::now;      ///< input_wait: for what, of input `number`, for `value` s at most
};

/// M0, M1, M60 and M6: the machine stands until the user says that it may go on.
[[nodiscard]] constexpr bool waits_for_user(EventKind kind) noexcept {
    return kind == EventKind::pause || kind == EventKind::optional_pause || kind == EventKind::pallet_pause ||
           kind == EventKind::tool_change;
}

/// "spindle_clockwise", "stop", ...: the words of element files and reports.
[[nodiscard]] const char* action_name(EventKind kind) noexcept;

} // namespace splinefeed::host
