// SPDX-License-Identifier: MIT
// SetpointWatch: checks by its reports whether a drive still follows its targets.
#pragma once

#include "splinefeed/hal/modbus/setpoint/setpoint_bus.hpp"

namespace splinefeed::hal::modbus {

/// Why a drive is taken for lost: "it does not answer any more: ...", or the exception that it answers with.
/// @param wire  its wire, for the reason of a lost connection; null: not known
[[nodiscard]] std::string silence(const LinkAnswer& last, const ModbusWire* wire = nullptr);

/// "it is in fault, code 7; ..."
[[nodiscard]] std::string fault_sentence(const DriveReading& reading);

/// Use one for each drive during a motion.
class SetpointWatch {
public:
    /// Returns what is wrong with the drive; empty: nothing.
    /// @param away_us   a drive without an answer for this long has failed
    /// @param began_us  start of the motion [us]
    [[nodiscard]] std::string trouble(const SetpointReport& report, std::uint64_t now_us, std::uint64_t away_us,
                                      std::uint64_t began_us);

private:
    DriveState state_ = DriveState::unknown;
    std::uint64_t state_seen_us_ = 0;    // when its state was first that
    std::uint64_t unknown_since_us_ = 0; // its state is unknown since then; 0: it is known
};

} // namespace splinefeed::hal::modbus
