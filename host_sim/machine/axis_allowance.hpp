// SPDX-License-Identifier: MIT
// AxisAllowance: the limits of an axis, with the tolerance that the simulated machine allows. Derivation:
// axis_allowance.cpp.
#pragma once

#include "host_sim/config/machine_description.hpp"
#include "host_sim/machine/segment_cubic.hpp"

#include <optional>

namespace splinefeed::host {

/// A limit with its tolerance: exceeded above `most` + `noise` (which is per T, T^2 or T^3).
struct Allowance {
    double limit = 0.0;
    double most = 0.0;
    double noise = 0.0;

    Allowance() = default;
    /// Tolerance: 1e-6 of the limit, and the noise. @param noise  in mm
    Allowance(double limit, double noise) noexcept;
};

/// In mm and s; the numbers are those of the machine file.
struct AxisAllowance {
    double units_per_mm = 1.0;
    Allowance velocity, acceleration, braking, jerk; ///< jerk 0: no limit
    bool brakes_differently = false;
    std::optional<Travel> travel;
    double lowest = 0.0; ///< lower end of the travel with its tolerance
    double highest = 0.0;
    Allowance end_velocity; ///< outside open_low to open_high; 0: none
    double open_low = 0.0;
    double open_high = 0.0;
    bool rotary = false;
    bool on_path = false; ///< the feed counts this axis; SimulatedMachine sets it

    AxisAllowance() = default;
    AxisAllowance(const AxisSettings& settings, const std::optional<Travel>& travel) noexcept;

    /// The largest accelerations from one fraction of a segment to another. If one limit holds for both signs, all of
    /// them are `speeding`.
    [[nodiscard]] Accelerations accelerations(const SegmentCubic& cubic, double from, double to) const noexcept;
};

} // namespace splinefeed::host
