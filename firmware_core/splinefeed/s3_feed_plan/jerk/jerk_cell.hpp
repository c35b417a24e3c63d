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
    R length_mm{};
    R cap_sq{};             ///< largest v^2 anywhere in the cell
    AxisLimits<R> limits{}; ///< acceleration: in either direction
    std::array<PerAxis<AxisEnd<R>>, 2> end{};

    /// Largest b at the moving end of a cell that begins or ends at standstill, with constant jerk along the path.
    /// @param moving  index of the moving end: 1: begins at standstill, 0: ends at standstill
    [[nodiscard]] R largest_from_rest(unsigned moving) const noexcept;
    /// Limits of a motion along the path up to a v^2. Every motion within them keeps the limits of the axes. The cell's
    /// cap is not included.
    [[nodiscard]] MoveLimits move_limits(R most_sq) const noexcept;
    /// Whether the cell is almost straight: up to this v^2 move_limits() are not smaller than necessary.
    [[nodiscard]] bool straight(R most_sq) const noexcept;
};

} // namespace splinefeed
