// SPDX-License-Identifier: MIT
#include "splinefeed/controller/alarm.hpp"

namespace splinefeed {

namespace {

// In a struct: its names stay in it where sources are compiled as one.
struct AlarmTable {
    using enum Alarm;
    static constexpr AlarmRow rows[] = {
        {none, false, false, "no alarm"},
        {limit_switch, true, true, "a limit switch is active: reset, unlock by $X, and jog away from it"},
        {outside_travel, true, false, "a move leaves the travel of the machine, which stopped before it: reset"},
        {stopped_in_motion, true, true, "stopped off the path: reset, and home or unlock by $X"},
        {probe_at_start, false, false, "the probe is in its final state before the move begins: unlock by $X"},
        {probe_without_contact, false, false, "the probe found nothing up to the end of its move: unlock by $X"},
        {homing_reset, false, true, "homing was stopped: home again by $H, or unlock by $X"},
        {homing_door, false, true, "the door was opened while homing: home again by $H, or unlock by $X"},
        {homing_pull_off, false, true,
         "a home switch stays active behind its pull-off: look at pull_off_mm and the switch"},
        {homing_not_found, false, true, "homing did not find its switch: look at the switch and at seek and travel"},
        {emergency_stop, true, true, "emergency stop: release it, and reset"},
        {spindle_speed, true, false, "the spindle did not come to its speed: look at its drive, and reset"},
        {drive_fault, true, true, "a drive reports a fault: remove its cause, and reset"},
        {link_lost, true, true, "the link to a drive was lost: look at its line, and reset"},
        {lines_lost, true, false,
         "more lines came than fit, and some are lost: count characters or wait for each ok; reset"},
    };
};

} // namespace

const AlarmRow& row_of(Alarm alarm) noexcept {
    for (const AlarmRow& row : AlarmTable::rows) {
        if (row.alarm == alarm) {
            return row;
        }
    }
    return AlarmTable::rows[0];
}

} // namespace splinefeed
