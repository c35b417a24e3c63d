// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/setpoint/setpoint_watch.hpp"

#include <algorithm>

namespace splinefeed::hal::modbus {

namespace {

constexpr std::uint64_t unknown_us =
    200'000; // allowed duration of a transition state that matches no test of the profile

} // namespace

std::string silence(const LinkAnswer& last, const ModbusWire* wire) {
    return last.fault == LinkFault::exception
               ? std::string("it answers every request with the exception \"") + exception_name(last.exception) +
                     "\"; check its profile against its manual"
               : "it does not answer any more: " +
                     (wire != nullptr ? describe(last, *wire) : std::string(describe(last.fault)));
}

std::string fault_sentence(const DriveReading& reading) {
    return "it is in fault, code " + std::to_string(reading.fault_code) + "; see its manual";
}

// A drive that has stopped by itself or lost its power does not follow.
std::string SetpointWatch::trouble(const SetpointReport& report, std::uint64_t now_us, std::uint64_t away_us,
                                   std::uint64_t began_us) {
    const bool unknown = report.status_us != 0 && report.reading.state == DriveState::unknown;
    unknown_since_us_ = !unknown ? 0 : unknown_since_us_ == 0 ? now_us : unknown_since_us_;
    if (now_us > std::max(report.answered_us, began_us) + away_us) {
        return silence(report.last);
    }
    if (report.clamped) {
        return "a position or speed exceeds the range of its register; check scale and clamp in its profile";
    }
    if (report.reading.state != state_) {
        state_ = report.reading.state;
        state_seen_us_ = now_us;
    }
    // On a serial line an answer may be one to another request (a gateway sent it twice): one reading proves nothing.
    if (report.status_us <= state_seen_us_ && state_ != DriveState::unknown) {
        return {};
    }
    switch (state_) {
    case DriveState::fault: return fault_sentence(report.reading);
    case DriveState::disabled:
    case DriveState::not_ready: return "it was disabled while it moved";
    case DriveState::quick_stop: return "it made a quick stop by itself; check its inputs and its watchdog";
    case DriveState::halted: return "it was halted from outside; check its inputs";
    case DriveState::homing: return "it began to home while it moved; check its inputs";
    case DriveState::unknown:
        return unknown && now_us > unknown_since_us_ + unknown_us
                   ? "its status matches no state of its profile; check the profile's states"
                   : "";
    case DriveState::enabled:
    case DriveState::moving: break;
    }
    return {};
}

} // namespace splinefeed::hal::modbus
