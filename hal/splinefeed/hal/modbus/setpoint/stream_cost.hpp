// SPDX-License-Identifier: MIT
// StreamCost: line time that a drive needs for its targets and status.
#pragma once

#include "splinefeed/hal/modbus/link/link_address.hpp"
#include "splinefeed/hal/modbus/profile/drive_profile.hpp"

namespace splinefeed::hal::modbus {

struct StreamCost {
    std::uint32_t target_us = 0;  ///< all frames of a target or block, with answers and silences
    std::uint32_t arrival_us = 0; ///< from the first byte of these until the last frame has arrived
    std::uint32_t status_us = 0;  ///< for reading state and position
    std::uint32_t read_us = 0;    ///< longest read of these
};

/// Computes the cost with functions 03 and 16, from baud rate, frame lengths, silences and the profile's turnaround. No
/// exchange is shorter than in the maker's table for this baud rate (or the next lower one in the table). For a tcp
/// link it contains the turnaround only: measure it instead.
[[nodiscard]] StreamCost stream_cost(const DriveProfile& profile, const LinkAddress& address) noexcept;

} // namespace splinefeed::hal::modbus
