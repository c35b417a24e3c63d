// SPDX-License-Identifier: MIT
// PvtAxis: the parameters of one axis of a drive, the reference of all axes, and the faults of an axis.
#pragma once

#include "host_sim/drive/motor_axis.hpp"
#include "splinefeed/hal/modbus/pvt/pvt_map.hpp"

namespace splinefeed::host {

struct PvtAxisParameters {
    double start_counts = 0.0;
    double stop_counts_s2 = 2e6;  ///< deceleration of a quick stop and of a fault
    double homing_counts_s = 5e4; ///< speed of the move to 0
    double homing_counts_s2 = 5e5;
    double largest_counts_s = 0.0;  ///< a larger speed is fault 3; 0: no limit
    double largest_counts_s2 = 0.0; ///< a larger acceleration is fault 3; 0: no limit
    MotorAxisParameters shaft;
};

/// Reference positions and speeds of the axes; axes that a drive does not have stand at 0.
struct PvtReference {
    PerAxis<double> counts{};
    PerAxis<double> counts_s{};

    /// The axis with the largest speed; the first one of several.
    [[nodiscard]] int fastest() const noexcept;
    [[nodiscard]] bool rests() const noexcept;
};

/// The motion of an axis in a step.
struct PvtAxisStep {
    double following_error_counts = 0.0;
    double counts_s = 0.0;
    double counts_s2 = 0.0;
    bool on_ring = false; ///< the limits apply only on the ring: a stop may be harder
};

/// The fault of an axis, or none: first the window of the following error (0: no window), then the limits, with a
/// tolerance for rounding.
[[nodiscard]] hal::modbus::PvtFault fault_of(const PvtAxisParameters& axis, const PvtAxisStep& step,
                                             double window_counts) noexcept;

} // namespace splinefeed::host
