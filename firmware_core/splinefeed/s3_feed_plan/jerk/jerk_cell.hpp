// SPDX-License-Identifier: MIT
// JerkCell: the limits of a cell for jerk-limited motion. Derivation: jerk_cell.cpp.
#pragma once

#include "splinefeed/base/capacity.hpp"
#include "splinefeed/s3_feed_plan/jerk/s_curve_profile.hpp"
#include "splinefeed/s3_feed_plan/jerk/speed_state.hpp"

namespace splinefeed {

/// Derivatives of one axis by the path length s at one end of a cell, and the limits there.
struct AxisEnd {
    double first = 0.0;         ///< dq/ds
    double second = 0.0;        ///< d2q/ds2 [1/mm]
    double third = 0.0;         ///< d3q/ds3 [1/mm^2]
    double second_spread = 0.0; ///< largest difference of the second derivative from this value in the cell
    double third_spread = 0.0;  ///< the same for the third derivative
    double most_forward = 0.0;  ///< largest acceleration in the axis's positive direction [mm/s^2]
    double most_backward = 0.0; ///< largest acceleration in its negative direction
};

/// Range of u = d2b/ds2 in a cell.
struct CurvatureRange {
    double low = 0.0;
    double high = 0.0;
};

/// A cell in which b = v^2 is a parabola of s.
struct JerkCell {
    int axes = 0;
    double length_mm = 0.0;
    double cap_sq = 0.0; ///< largest v^2 anywhere in the cell
    std::array<PerAxis<AxisEnd>, 2> end{};
    PerAxis<double> jerk_mm_s3{};

    /// Largest b at the moving end of a cell that begins or ends at standstill, with constant jerk along the path.
    /// @param moving  index of the moving end: 1: begins at standstill, 0: ends at standstill
    [[nodiscard]] double largest_from_rest(unsigned moving) const noexcept;
    /// Limits of a motion along the path up to a v^2. Every motion within them keeps the limits of the axes. The cell's
    /// cap is not included.
    [[nodiscard]] MoveLimits move_limits(double most_sq) const noexcept;
    /// Whether the cell is almost straight: up to this v^2 move_limits() are not smaller than necessary.
    [[nodiscard]] bool straight(double most_sq) const noexcept;
};

/// A cell and a direction of travel: with the curve or against it. Against the curve slopes, dq/ds and d3q/ds3 change
/// their signs; b, u and d2q/ds2 do not.
struct CellPassage {
    const JerkCell* cell = nullptr;
    bool backward = false;

    [[nodiscard]] const PerAxis<AxisEnd>& entry() const noexcept { return cell->end[backward ? 1 : 0]; }
    [[nodiscard]] const PerAxis<AxisEnd>& exit() const noexcept { return cell->end[backward ? 0 : 1]; }
    [[nodiscard]] double direction() const noexcept { return backward ? -1.0 : 1.0; }
};

} // namespace splinefeed
