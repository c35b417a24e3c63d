// SPDX-License-Identifier: MIT
// PathDerivativeBounds: how steep the axes get along a part of the path: what a jerk-limited motion of bounded cost has
// to know of it. Derivation: filtered_limits.cpp.
#pragma once

#include "splinefeed/s2_arc_length/cell.hpp"
#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"

namespace splinefeed {

/// Largest derivatives of one axis by the length s.
template <Scalar S>
struct AxisDemand {
    S first{};         ///< |dq/ds|
    S second{};        ///< |d2q/ds2| [1/mm]
    S third_with{};    ///< |d3q/ds3| where it has the sign of the second derivative [1/mm^2]
    S third_against{}; ///< and where it has the other
};

template <Scalar S>
struct PathDerivativeBounds {
    static constexpr int steepest_log2 = 29; ///< derivatives beyond are as good as infinite

    PerAxis<AxisDemand<S>> axis{};
    S cap_sq = largest<S>();        ///< smallest cap of v^2
    S programmed_sq = largest<S>(); ///< smallest programmed feed, squared
    bool beyond = false;            ///< some derivative has no place in the scalar: the path is to be crawled along

    /// Of one cell. @param cap_sq, programmed_sq  its own
    [[nodiscard]] static PathDerivativeBounds of(const Cell<S>& cell, const MotionLimits<S>& limits, S cap_sq,
                                                 S programmed_sq) noexcept;
    /// Of both parts of the path.
    void join(const PathDerivativeBounds& other, int axes) noexcept;
};

} // namespace splinefeed
