// SPDX-License-Identifier: MIT
// ControllerState: what the machine does, in the words of grbl. ControllerMode: what the operator has made of it.
// ControllerTask: what is done, for a line or to come to an end.
#pragma once

#include <cstdint>
#include <string_view>

namespace splinefeed {

enum class ControllerState : std::uint8_t {
    idle,
    run,
    hold,
    jog,
    alarm,
    door,
    check, ///< programs are read, and nothing moves
    home,
    sleep, ///< the drives are off
    tool,  ///< a tool is changed by hand
};

/// "Idle", "Run", ...
[[nodiscard]] constexpr std::string_view state_name(ControllerState state) noexcept {
    constexpr std::string_view names[] = {"Idle", "Run",   "Hold", "Jog",   "Alarm",
                                          "Door", "Check", "Home", "Sleep", "Tool"};
    return names[static_cast<unsigned>(state)];
}

/// Beside these the machine may be locked, and motion may come to an end.
enum class ControllerMode : std::uint8_t {
    ready,
    held,
    tool, ///< a tool is changed by hand
    door,
    closing, ///< the door's hold ends when the spindle has its speed
    check,
    sleep,
    count
};

/// As the status shows it, where nothing else is to be shown.
[[nodiscard]] constexpr ControllerState shown_in(ControllerMode mode) noexcept {
    using enum ControllerState;
    constexpr ControllerState shown[] = {idle, hold, tool, door, door, check, sleep};
    return shown[static_cast<unsigned>(mode)];
}

enum class ModeEvent : std::uint8_t { hold, tool, door, resume, settled, check, sleep, stop, alarm, reset, count };

/// What each event makes of each mode. A mode that stays the same: the event does nothing.
[[nodiscard]] constexpr ControllerMode mode_behind(ControllerMode mode, ModeEvent event) noexcept {
    using enum ControllerMode;
    constexpr ControllerMode table[static_cast<unsigned>(count)][static_cast<unsigned>(ModeEvent::count)] = {
        //  hold     tool     door     resume   settled  check    sleep    stop     alarm    reset
        {held, tool, door, ready, ready, check, sleep, ready, ready, ready},         // ready
        {held, held, door, ready, held, held, held, ready, ready, ready},            // held
        {held, tool, door, ready, tool, tool, tool, ready, ready, ready},            // tool
        {door, door, door, closing, door, door, door, door, ready, ready},           // door
        {held, closing, door, closing, ready, closing, closing, door, ready, ready}, // closing
        {check, check, check, check, check, check, sleep, check, check, ready},      // check
        {sleep, sleep, sleep, sleep, sleep, sleep, sleep, sleep, sleep, ready},      // sleep
    };
    return table[static_cast<unsigned>(mode)][static_cast<unsigned>(event)];
}

/// One at a time: an end takes the place of what a line has asked for.
enum class ControllerTask : std::uint8_t {
    none,
    line,
    rest, ///< its next item needs the machine at rest
    jog,
    dwell,
    spindle,
    tool,
    input,
    probe,
    touched,
    keep, ///< a start-up line, where the machine stands
    home,
    // The motion comes to its end, because of:
    jog_cancel,
    alarm,
    stop,
    reset,
};

/// A line was taken, and its answer is due.
[[nodiscard]] constexpr bool is_of_line(ControllerTask task) noexcept {
    return task > ControllerTask::none && task < ControllerTask::jog_cancel;
}
[[nodiscard]] constexpr bool is_end(ControllerTask task) noexcept {
    return task >= ControllerTask::jog_cancel;
}

} // namespace splinefeed
