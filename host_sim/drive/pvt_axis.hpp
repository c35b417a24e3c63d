// SPDX-License-Identifier: MIT
// PvtAxis: what one axis of a drive can do, where the axes are to be, and what trips them.
#pragma once

#include "host_sim/drive/motor_axis.hpp"
#include "splinefeed/hal/modbus/pvt/pvt_map.hpp"

namespace splinefeed::host {

struct PvtAxisParameters {
    double start_counts = 0.0;
    double stop_counts_s2 = 2e6;  ///< deceleration of a quick stop and after a fault
    double homing_counts_s = 5e4; ///< speed on the way to 0
    double homing_counts_s2 = 5e5;
    double largest_counts_s = 0.0;  ///< beyond: fault 3; 0: any
    double largest_counts_s2 = 0.0; ///< beyond: fault 3; 0: any
    MotorAxisParameters shaft;
};

/// Where the axes are to be, and how fast; those that a drive does not have are at rest at 0.
struct PvtReference {
    PerAxis<double> counts{};
    PerAxis<double> counts_s{};

    /// The axis whose speed is the largest, the first of several.
    [[nodiscard]] int fastest() const noexcept;
    [[nodiscard]] bool rests() const noexcept;
};

/// What an axis does in a step.
struct PvtAxisStep {
    double following_error_counts = 0.0;
    double counts_s = 0.0;
    double counts_s2 = 0.0;
    bool on_ring = false; ///< only there the limits count: a stop may be harder
};

/// What trips it, or none: the window of the following error (0: there is none), then the limits, but for rounding.
[[nodiscard]] hal::modbus::PvtFault fault_of(const PvtAxisParameters& axis, const PvtAxisStep& step,
                                             double window_counts) noexcept;

} // namespace splinefeed::host
