// SPDX-License-Identifier: MIT
// target_stop: what is known of the stop of a drive that is told where to be.
#pragma once

#include "splinefeed/hal/modbus/setpoint/setpoint_bus.hpp"

namespace splinefeed::hal::modbus {

/// @param began_us  when the stop was asked for
[[nodiscard]] StopFacts stop_facts(const SetpointReport& report, SetpointMotion& motion,
                                   std::uint64_t began_us) noexcept;

/// Whether it follows, and is where the motion stands. [counts] @pre the motion is stopping, or never began
[[nodiscard]] bool stands_on_path(const SetpointReport& report, SetpointMotion& motion, int axis,
                                  double tolerance_counts) noexcept;

} // namespace splinefeed::hal::modbus
