// SPDX-License-Identifier: MIT
// SetpointStandby: polls the enabled drives of a run while another drive is prepared.
#pragma once

#include "splinefeed/hal/modbus/setpoint/setpoint_drive.hpp"

namespace splinefeed::hal::modbus {

/// Polling feeds their watchdogs and detects their faults.
class SetpointStandby {
public:
    /// @param away_us  a drive without an answer for this long is a failure
    explicit SetpointStandby(std::uint64_t away_us) noexcept : away_us_(away_us) {}

    /// Adds an enabled drive, which must outlive this object.
    void add(SetpointDrive& drive) { drives_.push_back(&drive); }
    /// Polls each drive except `but` once. Returns what is wrong with drive troubled(); empty: nothing.
    [[nodiscard]] std::string poll_others(const SetpointDrive& but);
    /// Index of the failed drive, in the order of add().
    [[nodiscard]] std::size_t troubled() const noexcept { return troubled_; }

private:
    std::uint64_t away_us_;
    std::vector<SetpointDrive*> drives_;
    std::size_t troubled_ = 0;
};

} // namespace splinefeed::hal::modbus
