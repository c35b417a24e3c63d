// SPDX-License-Identifier: MIT
// StreamCost: what it takes to keep a drive moving, in time of its line.
#pragma once

#include "splinefeed/hal/modbus/link/link_address.hpp"
#include "splinefeed/hal/modbus/profile/drive_profile.hpp"

namespace splinefeed::hal::modbus {

struct StreamCost {
    std::uint32_t target_us = 0;  ///< the frames of a target or block, their answers and silences
    std::uint32_t arrival_us = 0; ///< from the first byte of these until the last frame has arrived
    std::uint32_t status_us = 0;  ///< to read state and position
    std::uint32_t read_us = 0;    ///< the longest frame of these
};

/// With functions 03 and 16: from the baud rate, the lengths of the frames, the silences and the turnaround of the
/// profile, and no exchange shorter than its maker's table says for this baud rate (that of the next slower rate in the
/// table). A tcp link counts with its turnaround alone: measure it.
[[nodiscard]] StreamCost stream_cost(const DriveProfile& profile, const LinkAddress& address) noexcept;

} // namespace splinefeed::hal::modbus
