// SPDX-License-Identifier: MIT
// SpeedCaps: the largest speed in a cell, from every limit that does not depend on the cells beside it.
#pragma once

#include "splinefeed/s2_arc_length/cell.hpp"
#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"

namespace splinefeed {

/// All results are v^2 [mm^2/s^2]. Cost: a product and up to two divisions for each axis.
template <Scalar S>
class SpeedCaps {
public:
    /// `limits` must outlive it.
    explicit SpeedCaps(const MotionLimits<S>& limits) noexcept : limits_(limits) {}

    /// What the machine allows, whatever the programmed feed. This is the only place where a limit of the speed is
    /// stated.
    [[nodiscard]] S cap_sq(const Cell<S>& cell) const noexcept;
    /// What is wanted in a cell with this cap, for a factor of the programmed feed.
    [[nodiscard]] S wanted_sq(const Cell<S>& cell, S cap_sq, S ratio) const noexcept;
    /// The feed that is programmed for a cell; if none is programmed, the machine's feed.
    [[nodiscard]] S programmed_sq(const Cell<S>& cell) const noexcept;

private:
    [[nodiscard]] S path_speed(const Cell<S>& cell, S feed) const noexcept;

    const MotionLimits<S>& limits_;
};

} // namespace splinefeed
