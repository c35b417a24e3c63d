// SPDX-License-Identifier: MIT
// SetpointWiring: a drive of a SetpointPort, the axis that it moves, and its deviations from the path.
#pragma once

#include "splinefeed/hal/modbus/link/link_address.hpp"
#include "splinefeed/hal/modbus/profile/drive_profile.hpp"

namespace splinefeed::hal::modbus {

/// A drive of one axis.
struct SetpointWiring {
    LinkAddress link;
    const DriveProfile* profile = nullptr; ///< must outlive the port
    int axis = 0;                          ///< of the machine
    double acceleration_counts_s2 = 1e6;   ///< planned acceleration of that axis
    /// For a drive with blocks: acceleration of its ramps, written if its profile has registers for it.
    /// BlockSettings::acceleration
    double ramp_counts_s2 = 4e6;
    double fastest_counts_s = 0.0;  ///< of a drive that catches up, BlockSettings::fastest, CyclicSettings::fastest
    bool inverted = false;          ///< the drive counts in the opposite direction
    double standstill_counts = 2.0; ///< how far apart positions of a shaft that stands may lie
};

/// How far ahead a target is: for blocks until the next block, for cyclic targets until the end of the drive's own
/// period. [us]
[[nodiscard]] std::uint32_t horizon_us(const SetpointWiring& wiring, std::uint32_t period_us) noexcept;

/// Deviation by the rounding of registers: half a unit of the position's, more if targets overlap, and half a unit of
/// the speed's times the period. [counts]
[[nodiscard]] double rounding_counts(const SetpointWiring& wiring, std::uint32_t period_us) noexcept;

/// Deviation by a late target, at that speed, if all drives stop within stop_us. [counts]
[[nodiscard]] double late_counts(const SetpointWiring& wiring, std::uint32_t period_us, std::uint64_t late_us,
                                 double speed_counts_s, std::uint32_t stop_us) noexcept;

} // namespace splinefeed::hal::modbus
