// SPDX-License-Identifier: MIT
// PortTimes: what the drives of a ModbusPort are judged by.
#pragma once

#include <cstdint>

namespace splinefeed::hal::modbus {

/// Times that all drives of a port have in common. [us]
struct PortTimes {
    double segment_us = 0.0;
    double reserve_us = 0.0;       ///< motion over which a drive slows down to rest
    std::uint64_t silent_us = 0;   ///< a drive that was not heard for this long is away
    std::uint64_t settling_us = 0; ///< until what a drive says tells of what it was told
};

} // namespace splinefeed::hal::modbus
