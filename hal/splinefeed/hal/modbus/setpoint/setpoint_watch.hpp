// SPDX-License-Identifier: MIT
// SetpointWatch: whether a drive that is told where to be still follows, by what it says.
#pragma once

#include "splinefeed/hal/modbus/setpoint/setpoint_bus.hpp"

namespace splinefeed::hal::modbus {

/// One for each drive, while it is to follow.
class SetpointWatch {
public:
    /// What is wrong with it; empty: nothing.
    /// @param away_us   not having answered for this long is trouble
    /// @param began_us  since when it is to follow
    [[nodiscard]] std::string trouble(const SetpointReport& report, std::uint64_t now_us, std::uint64_t away_us,
                                      std::uint64_t began_us);

private:
    std::uint64_t unknown_since_us_ = 0; // its state is unknown since then; 0: it is not
};

} // namespace splinefeed::hal::modbus
