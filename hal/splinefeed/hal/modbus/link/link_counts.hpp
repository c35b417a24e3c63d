// SPDX-License-Identifier: MIT
// LinkCounts: how the wire to a drive did so far.
#pragma once

#include "splinefeed/hal/modbus/link/modbus_line.hpp"

namespace splinefeed::hal::modbus {

struct LinkCounts {
    std::uint64_t exchanges = 0; ///< answered
    std::uint64_t segments = 0;  ///< taken by the drive, each counted once; or targets
    std::uint64_t timeouts = 0;
    std::uint64_t disconnects = 0;
    std::uint64_t corrupt = 0; ///< checksum of the frame, of the status, or of our block as the drive saw it
    std::uint64_t stale = 0;   ///< answers to an earlier request
    std::uint64_t misfits = 0; ///< wrong unit or length
    std::uint64_t exceptions = 0;
    std::uint64_t resent = 0; ///< blocks of which the drive had taken some

    void count(LinkFault fault) noexcept {
        switch (fault) {
        case LinkFault::none: ++exchanges; break;
        case LinkFault::timeout: ++timeouts; break;
        case LinkFault::disconnected: ++disconnects; break;
        case LinkFault::corrupt: ++corrupt; break;
        case LinkFault::wrong_unit:
        case LinkFault::wrong_length: ++misfits; break;
        case LinkFault::exception: ++exceptions; break;
        case LinkFault::bad_unit: break; // it never was on the wire
        }
    }
};

} // namespace splinefeed::hal::modbus
