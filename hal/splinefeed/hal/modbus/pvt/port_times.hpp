// SPDX-License-Identifier: MIT
// PortTimes: times by which ModbusPort supervises its drives.
#pragma once

#include <cstdint>

namespace splinefeed::hal::modbus {

/// Times common to all drives of a port. [us]
struct PortTimes {
    static constexpr std::uint64_t lead_us = 60'000; ///< from sending a command to the instant that it names

    double segment_us = 0.0;
    double reserve_us = 0.0;       ///< motion time over which a drive slows down to standstill
    std::uint64_t silent_us = 0;   ///< a drive without an answer for this long is offline
    std::uint64_t away_us = 0;     ///< offline for this long, it does not come back
    std::uint64_t settling_us = 0; ///< from a command until a drive's status reflects it
};

} // namespace splinefeed::hal::modbus
