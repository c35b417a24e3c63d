// SPDX-License-Identifier: MIT
// LinkCounts: statistics of the exchanges with a drive.
#pragma once

#include "splinefeed/hal/modbus/link/modbus_wire.hpp"

namespace splinefeed::hal::modbus {

struct LinkCounts {
    std::uint64_t exchanges = 0; ///< exchanges with an answer
    std::uint64_t segments = 0;  ///< segments that the drive accepted, each counted once; or setpoints sent
    std::uint64_t timeouts = 0;
    std::uint64_t disconnects = 0;
    std::uint64_t corrupt = 0; ///< checksum errors: of a frame, of the status, or of our block at the drive
    std::uint64_t stale = 0;   ///< answers to an earlier request
    std::uint64_t misfits = 0; ///< wrong unit or length
    std::uint64_t exceptions = 0;
    std::uint64_t resent = 0; ///< blocks with segments that were sent before

    void count(LinkFault fault) noexcept {
        switch (fault) {
        case LinkFault::none: ++exchanges; break;
        case LinkFault::timeout: ++timeouts; break;
        case LinkFault::disconnected: ++disconnects; break;
        case LinkFault::corrupt: ++corrupt; break;
        case LinkFault::wrong_unit:
        case LinkFault::wrong_length: ++misfits; break;
        case LinkFault::exception: ++exceptions; break;
        case LinkFault::bad_unit: break; // nothing was sent
        }
    }
};

} // namespace splinefeed::hal::modbus
