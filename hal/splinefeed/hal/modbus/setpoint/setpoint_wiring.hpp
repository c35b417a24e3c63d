// SPDX-License-Identifier: MIT
// SetpointWiring: a drive that is told where to be, the axis that it moves, and how near to a target it can get.
#pragma once

#include "splinefeed/hal/modbus/link/link_address.hpp"
#include "splinefeed/hal/modbus/profile/drive_profile.hpp"

namespace splinefeed::hal::modbus {

/// A drive of one axis.
struct SetpointWiring {
    LinkAddress link;
    const DriveProfile* profile = nullptr; ///< must outlive the port
    int axis = 0;                          ///< of the machine
    double acceleration_counts_s2 = 1e6;   ///< of that axis, as planned
    /// Of a drive that is told blocks: what its ramps are set to, or are where its profile has no register for them.
    /// BlockSettings::acceleration
    double ramp_counts_s2 = 4e6;
    double fastest_counts_s = 0.0; ///< of a drive that catches up, BlockSettings::fastest
    bool inverted = false;         ///< the drive counts down where the axis goes up
};

/// How far ahead a target is: a block's at the next one, a cyclic one at the end of the drive's own period.
[[nodiscard]] std::uint32_t horizon_us(const SetpointWiring& wiring, std::uint32_t period_us) noexcept;

/// What its registers round: half a unit of the position's, more where targets overlap, and what half a unit of the
/// speed's makes in a period. [counts]
[[nodiscard]] double rounding_counts(const SetpointWiring& wiring, std::uint32_t period_us) noexcept;

/// How far off the path a target that comes late lets it get, at that speed, where all stop within stop_us. [counts]
[[nodiscard]] double late_counts(const SetpointWiring& wiring, std::uint32_t period_us, std::uint64_t late_us,
                                 double speed_counts_s, std::uint32_t stop_us) noexcept;

} // namespace splinefeed::hal::modbus
