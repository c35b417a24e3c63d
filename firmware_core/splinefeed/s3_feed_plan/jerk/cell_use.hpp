// SPDX-License-Identifier: MIT
// cell_use: how much of the limits a motion uses within a cell, proved.
#pragma once

#include "splinefeed/s3_feed_plan/jerk/leg_node.hpp"

namespace splinefeed {

/// Use of a limit in a cell; up to 1 it is kept.
template <Floating R>
struct LimitUse {
    R most{}; ///< an upper bound of the use anywhere
    R ends{}; ///< the larger one of those at the ends, of the axis with the largest use
};

template <Floating R>
struct CellUse {
    LimitUse<R> acceleration;
    LimitUse<R> jerk;
};

/// The use of the cell between two nodes that are both in motion, from their b and slope, and its middle_sq and
/// curvature. Where it is above 1, the cell
/// is halved up to four times for a closer bound. Derivation: cell_use.cpp. Cost: about 100 operations an axis.
template <Floating R>
[[nodiscard]] CellUse<R> cell_use(const LegNode<R>& node, const LegNode<R>& next, const AxisLimits<R>& limits) noexcept;

} // namespace splinefeed
