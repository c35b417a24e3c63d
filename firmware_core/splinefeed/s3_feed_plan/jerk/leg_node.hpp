// SPDX-License-Identifier: MIT
// LegNode: a node of a leg that is being planned, with the cell after it. It is what LegSolver computes with.
#pragma once

#include "splinefeed/base/capacity.hpp"
#include "splinefeed/s3_feed_plan/jerk/pair.hpp"

namespace splinefeed {

/// One axis at a node: its derivatives by the path length, and what the solver knows of its limits there. A multiplier
/// has the sign of the row that it belongs to.
template <Floating R>
struct LegAxis {
    R first{};               ///< dq/ds
    R second{};              ///< d2q/ds2 [1/mm]
    Pair<R> third{};         ///< d3q/ds3 [1/mm^2], in the cell before and in the cell after the node
    Pair<R> second_spread{}; ///< largest difference of the second derivative from this value in each of them
    Pair<R> third_spread{};  ///< the same for the third derivative
    R acceleration_multiplier{};
    R per_acceleration_slack{};
    Pair<R> jerk_multiplier{};
    Pair<R> per_jerk_slack{};
};

/// Limits of the axes, the same in all cells of a leg.
template <Floating R>
struct AxisLimits {
    int axes = 0;
    PerAxis<R> velocity_mm_s{};
    PerAxis<R> acceleration_mm_s2{};
    PerAxis<R> jerk_mm_s3{};
};

/// Scratch: nothing in it has to survive the planning of a leg.
template <Floating R>
struct LegNode {
    R length_mm{};
    R per_length{};
    R cap_sq{};    ///< largest middle
    R most_sq{};   ///< the same by the velocities of the axes alone
    R likely_sq{}; ///< an expected b of the cell, for instance that of the acceleration-limited plan
    R known_sq{};  ///< middle_sq in an earlier plan
    R middle_sq{}; ///< the unknown: the middle Bezier point of b in the cell
    R b{};
    R slope{};     ///< db/ds
    R curvature{}; ///< d2b/ds2 in the cell: not from differences of b, which lose it in short cells
    R of_before{}; ///< b = of_before * middle of the cell before + of_own * middle
    R of_own{};
    R slope_of_before{}; ///< and db/ds
    R slope_of_own{};
    R weight_mm{};       ///< the path length that the node stands for
    R most_share = R{1}; ///< of the limits in the cell: beside a kink something is left for it
    R jerk_share = R{1}; ///< of the limits, which rows at the ends of the cell may use
    R acceleration_share = R{1};
    R cap_multiplier{};
    R per_cap_slack{};
    R excess{};              ///< of the first motion over the limits of this node, as a part of them
    std::array<R, 3> gain{}; ///< change of the curvature: gain[0] + gain[1] db + gain[2] dslope
    std::size_t corner = 0;  ///< of an envelope (leg_guess.cpp)
    PerAxis<LegAxis<R>> axis{};
};

} // namespace splinefeed
