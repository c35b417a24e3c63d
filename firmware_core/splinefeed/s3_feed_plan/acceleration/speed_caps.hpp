// SPDX-License-Identifier: MIT
// SpeedCaps: the largest speed in a cell, from every limit that does not depend on the cells beside it.
#pragma once

#include "splinefeed/s2_arc_length/cell.hpp"
#include "splinefeed/s3_feed_plan/acceleration/cap_line.hpp"
#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"
#include "splinefeed/s3_feed_plan/steering/steering.hpp"

namespace splinefeed {

/// All results are v^2 [mm^2/s^2]. Cost: ten products and up to two divisions for each axis.
template <Scalar S>
class SpeedCaps {
public:
    /// The lowest speed away from stops, squared: below the least limit of a machine file, 1e-3 mm/s, less what is kept
    /// of it for rounding. Below that, the time per cell has no digits in Fixed.
    static constexpr double slowest_sq = 0.9e-3 * 0.9e-3;

    /// `limits` must outlive it.
    explicit SpeedCaps(const MotionLimits<S>& limits) noexcept : limits_(limits) {}

    /// What the machine allows, whatever the programmed feed. This is the only place where a limit of the speed is
    /// stated.
    [[nodiscard]] CapLine<S> cap(const Cell<S>& cell) const noexcept;
    /// The same, one number for the cell, for a plan that keeps the velocities of the axes in a bent cell by itself
    /// (JerkCell).
    [[nodiscard]] S bent_cap_sq(const Cell<S>& cell) const noexcept;
    /// What an operator wants in a cell with this cap.
    [[nodiscard]] CapLine<S> wanted(const Cell<S>& cell, const CapLine<S>& cap, const FeedWish<S>& wish) const noexcept;
    /// The same of a cap that is one number.
    [[nodiscard]] S wanted_sq(const Cell<S>& cell, S cap_sq, const FeedWish<S>& wish) const noexcept {
        return wanted(cell, {cap_sq, cap_sq}, wish).entry_sq;
    }

private:
    [[nodiscard]] S fastest_speed(const Cell<S>& cell) const noexcept;
    [[nodiscard]] S bends_sq(const Cell<S>& cell) const noexcept;
    [[nodiscard]] static CapLine<S> velocity_line(const Cell<S>& cell, unsigned axis, S velocity) noexcept;
    [[nodiscard]] S fastest_feed(const Cell<S>& cell) const noexcept;
    [[nodiscard]] S path_speed(const Cell<S>& cell, S feed) const noexcept;

    const MotionLimits<S>& limits_;
};

} // namespace splinefeed
