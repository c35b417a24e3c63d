// SPDX-License-Identifier: MIT
// SetpointStandby: the drives of a run that are enabled, while another one is made ready.
#pragma once

#include "splinefeed/hal/modbus/setpoint/setpoint_drive.hpp"

namespace splinefeed::hal::modbus {

/// They are heard all the while, so that their watchdogs do not run out, and a fault of one is seen.
class SetpointStandby {
public:
    /// @param away_us  a drive that was not heard for this long is in trouble
    explicit SetpointStandby(std::uint64_t away_us) noexcept : away_us_(away_us) {}

    /// An enabled drive, which must outlive it.
    void add(SetpointDrive& drive) { drives_.push_back(&drive); }
    /// Hears each but that one, once. What is wrong with troubled(); empty: nothing.
    [[nodiscard]] std::string poll_others(const SetpointDrive& but);
    /// Index in the order of add().
    [[nodiscard]] std::size_t troubled() const noexcept { return troubled_; }

private:
    std::uint64_t away_us_;
    std::vector<SetpointDrive*> drives_;
    std::size_t troubled_ = 0;
};

} // namespace splinefeed::hal::modbus
