// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/setpoint/setpoint_stop.hpp"

#include <cmath>

namespace splinefeed::hal::modbus {

namespace {

// The stop that a drive made by itself, by its state; none: it follows its targets.
StopRequest stopped_itself(DriveState state) noexcept {
    switch (state) {
    case DriveState::fault:
    case DriveState::disabled:
    case DriveState::not_ready: return StopRequest::disable;
    case DriveState::quick_stop:
    case DriveState::halted: return StopRequest::quick_stop;
    case DriveState::enabled:
    case DriveState::moving:
    case DriveState::homing:
    case DriveState::unknown: break;
    }
    return StopRequest::none;
}

} // namespace

// A hold is executed when a target on the path has arrived after the clock's standstill, or if the motion never began.
// That target may still move a drive that was away: how long it stood before says nothing.
StopFacts stop_facts(const SetpointReport& report, SetpointMotion& motion, std::uint64_t began_us) noexcept {
    StopFacts facts{.status_us = report.status_us,
                    .standstill = report.still_us >= standstill_us,
                    .executed = report.executed,
                    .executed_us = report.executed_us};
    const StopRequest itself = stopped_itself(report.reading.state);
    if (itself > facts.executed && report.status_us > began_us) {
        facts.executed = itself;
        facts.executed_us = began_us;
    }
    if (facts.executed != StopRequest::none) {
        return facts;
    }
    const std::lock_guard lock(motion.mutex);
    const bool began = motion.clock.stopping();
    const std::uint64_t stands_us = began ? motion.clock.standstill_from() : began_us;
    if (!began) {
        facts.executed = StopRequest::hold;
        facts.executed_us = stands_us;
    } else if (report.rest_setpoint_us >= stands_us && !report.behind) {
        facts.executed = StopRequest::hold;
        facts.executed_us = report.rest_setpoint_us;
        facts.standstill = facts.standstill && report.status_us >= report.rest_setpoint_us + standstill_us;
    }
    return facts;
}

bool stands_on_path(const SetpointReport& report, SetpointMotion& motion, int axis, double tolerance_counts) noexcept {
    if (report.reading.state != DriveState::enabled && report.reading.state != DriveState::moving) {
        return false;
    }
    const std::lock_guard lock(motion.mutex);
    if (motion.trajectory.empty() || !motion.clock.stopping()) {
        return true; // it never began to move
    }
    const std::uint64_t stands_us = motion.clock.time(motion.clock.standstill_from());
    const std::int64_t off_q16 = report.reading.position_q16 - motion.trajectory.at(axis, stands_us).position_q16;
    return std::fabs(static_cast<double>(off_q16)) / (1 << physical_bits) <= tolerance_counts;
}

} // namespace splinefeed::hal::modbus
