// SPDX-License-Identifier: MIT
// setpoint_stop: facts about the stop of a SetpointPort's drive, for StopSequence.
#pragma once

#include "splinefeed/hal/modbus/setpoint/setpoint_bus.hpp"

namespace splinefeed::hal::modbus {

/// @param began_us  when the stop was requested [us]
[[nodiscard]] StopFacts stop_facts(const SetpointReport& report, SetpointMotion& motion,
                                   std::uint64_t began_us) noexcept;

/// Whether the drive is enabled and stands where the motion stopped, within the tolerance. @pre the motion is stopping,
/// or never began
[[nodiscard]] bool stands_on_path(const SetpointReport& report, SetpointMotion& motion, int axis,
                                  double tolerance_counts) noexcept;

} // namespace splinefeed::hal::modbus
