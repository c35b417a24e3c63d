// SPDX-License-Identifier: MIT
// Alarm: why the machine was stopped, by numbers that senders know.
#pragma once

#include <cstdint>
#include <string_view>

namespace splinefeed {

/// grblHAL's numbers, because senders show their texts; 1 to 9 are also grbl's. 0: none.
enum class Alarm : std::uint8_t {
    none = 0,
    limit_switch = 1,
    outside_travel = 2,
    stopped_in_motion = 3,
    probe_at_start = 4,
    probe_without_contact = 5,
    homing_reset = 6,
    homing_door = 7,
    homing_pull_off = 8,
    homing_not_found = 9,
    emergency_stop = 10,
    spindle_speed = 14,
    drive_fault = 17,
    link_lost = 19,
    lines_lost = 22,
};

struct AlarmRow {
    Alarm alarm = Alarm::none;
    bool needs_reset = false;  ///< only a reset ends it
    bool stays = false;        ///< and behind that the machine is locked until $H or $X
    std::string_view sentence; ///< what happened, and what to do
};

/// The row of an alarm.
[[nodiscard]] const AlarmRow& row_of(Alarm alarm) noexcept;

} // namespace splinefeed
