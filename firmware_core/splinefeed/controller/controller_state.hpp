// SPDX-License-Identifier: MIT
// ControllerState: what the machine does, in the words of grbl.
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

} // namespace splinefeed
