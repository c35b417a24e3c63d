// SPDX-License-Identifier: MIT
// DriveProblem: why a drive with the map splinefeed-pvt cannot be used.
#pragma once

#include "splinefeed/hal/modbus/pvt/pvt_map.hpp"

namespace splinefeed::hal::modbus {

/// What is wrong with a drive, for good: it takes no more segments until it is opened again.
enum class DriveProblem : std::uint8_t {
    none,
    unreachable,   ///< no connection
    silent,        ///< connected, but no answer
    damaged,       ///< it answers, and the checksum of its status never holds
    not_pvt,       ///< no magic number: another map
    words_swapped, ///< the drive, or a gateway, has the other word order
    version,       ///< of the map
    axes,          ///< fewer than the machine file asks for
    ticks,         ///< it counts time in other ticks
    power_cycled,  ///< it was switched off and on: what it had is lost
    fault,         ///< its own: PvtStatus::fault
    refused,       ///< a command, or segments that no repetition makes better
    out_of_step,   ///< it reports segments that nobody sent
    not_homed,     ///< its homing did not come to its end
    range,         ///< a position, velocity or duration does not fit the map; nothing of it was sent
};

/// Which drive of several it is about, and what.
struct DriveFailure {
    std::size_t drive = 0;
    DriveProblem problem = DriveProblem::none;
};

/// What is wrong and what to look at.
[[nodiscard]] const char* describe(DriveProblem problem) noexcept;

/// Whether that is a drive of the map that we speak.
[[nodiscard]] DriveProblem identity_problem(const PvtIdentity& identity, int least_axes) noexcept;

/// With the low word first.
[[nodiscard]] constexpr std::uint32_t swapped_words(std::uint32_t value) noexcept {
    constexpr unsigned half = 16;
    return value << half | value >> half;
}

} // namespace splinefeed::hal::modbus
