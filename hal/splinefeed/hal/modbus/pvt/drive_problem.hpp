// SPDX-License-Identifier: MIT
// DriveProblem: permanent problems of a drive with the map splinefeed-pvt.
#pragma once

#include "splinefeed/hal/modbus/pvt/pvt_map.hpp"

#include <string>
#include <vector>

namespace splinefeed::hal::modbus {

/// A permanent problem: the drive gets no more segments until it is opened again.
enum class DriveProblem : std::uint8_t {
    none,
    unreachable,   ///< no connection
    silent,        ///< connected, but no answer
    damaged,       ///< it answers, but with wrong checksums, or differently each time
    not_kept,      ///< it does not keep the configuration that was written
    not_pvt,       ///< no magic number: the drive has another map
    words_swapped, ///< the drive or a gateway uses the other word order
    version,       ///< unknown version of the map
    axes,          ///< fewer axes than the machine file needs
    ticks,         ///< its time unit is not 1/8 us
    power_cycled,  ///< the drive restarted: its segments are lost
    fault,         ///< a fault of the drive: PvtStatus::fault
    refused,       ///< it refuses a command, or refuses segments repeatedly
    ignores,       ///< it answers, but neither executes nor refuses a command
    out_of_step,   ///< it reports segments that were never sent
    unknown_state, ///< it reports a state that the map does not have
    switched_off,  ///< it is disabled, and the port did not ask for that
    busy,          ///< another program exchanges data with it: nothing was sent
    taken,         ///< another program ended this program's session
    takes_nothing, ///< it stands ready, but accepts no more segments
    frozen,        ///< it is to run, but executes no segments
    unfinished,    ///< it executed all segments, but does not report that it stands
    not_standing,  ///< it does not come to a standstill
    moves,         ///< it moves before this run has sent anything
    not_homed,     ///< its homing was not completed within its time
    interrupted,   ///< its homing was interrupted by the user
    ring,          ///< its ring is shorter than the map requires
    overrun,       ///< it would have got a segment for which there was no room; nothing of it was sent
    range,         ///< a position, velocity or duration does not fit the map; nothing of it was sent
};

/// A problem and the index of its drive; PortFailure says it to the user.
struct DriveFailure {
    std::size_t drive = 0;
    DriveProblem problem = DriveProblem::none;
};

/// Text for messages: what is wrong and what to check.
[[nodiscard]] const char* describe(DriveProblem problem) noexcept;

/// "code 3 on axis x: following error". @param axis_names  of the drive's axes; an axis without one has its number
[[nodiscard]] std::string fault_text(const PvtStatus& status, const std::vector<std::string>& axis_names);

/// Checks whether a drive has a supported version of the map.
[[nodiscard]] DriveProblem identity_problem(const PvtIdentity& identity, int least_axes) noexcept;

/// Swaps the two 16-bit words.
[[nodiscard]] constexpr std::uint32_t swapped_words(std::uint32_t value) noexcept {
    constexpr unsigned half = 16;
    return value << half | value >> half;
}

} // namespace splinefeed::hal::modbus
