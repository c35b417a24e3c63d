// SPDX-License-Identifier: MIT
// JerkCell: the limits of a cell for jerk-limited motion. Derivation: jerk_cell.cpp.
#pragma once

#include "splinefeed/s3_feed_plan/jerk/leg_node.hpp"
#include "splinefeed/s3_feed_plan/jerk/s_curve_profile.hpp"

namespace splinefeed {

/// Derivatives of one axis by the path length s at one end of a cell.
template <Floating R>
struct AxisEnd {
    R first{};         ///< dq/ds
    R second{};        ///< d2q/ds2 [1/mm]
    R third{};         ///< d3q/ds3 [1/mm^2]
    R second_spread{}; ///< largest difference of the second derivative from this value in the cell
    R third_spread{};  ///< the same for the third derivative
};

/// A cell in which b = v^2 is a parabola of s.
template <Floating R>
struct JerkCell {
    static constexpr double unlimited_sq = 1e18;

    R length_mm{};
    R cap_sq{}; ///< largest v^2 anywhere in the cell, but for the velocities of the axes
    std::array<R, 2> most_sq{R(unlimited_sq), R(unlimited_sq)}; ///< these allow b up to the line between its ends
    R share{1};             ///< of the accelerations and jerks below: beside a kink something is left for it
    AxisLimits<R> limits{}; ///< acceleration: in either direction
    std::array<PerAxis<AxisEnd<R>>, 2> end{};

    /// Sets most_sq for an axis. @param spread  largest difference of dq/ds from the cubic that `end` gives
    void limit_velocity(unsigned axis, R spread) noexcept;
    /// Largest b at the moving end of a cell that begins or ends at standstill, with constant jerk along the path.
    /// @param moving  index of the moving end: 1: begins at standstill, 0: ends at standstill
    [[nodiscard]] R largest_from_rest(unsigned moving) const noexcept;
    /// Limits of a motion along the path up to a v^2. Every motion within them keeps the limits of the axes. The cell's
    /// cap_sq is not included.
    [[nodiscard]] MoveLimits move_limits(R at_most_sq) const noexcept;
    /// Whether the cell is almost straight: up to this v^2 move_limits() are not smaller than necessary.
    [[nodiscard]] bool straight(R at_most_sq) const noexcept;
};

} // namespace splinefeed
