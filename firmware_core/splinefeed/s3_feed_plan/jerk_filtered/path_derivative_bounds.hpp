// SPDX-License-Identifier: MIT
// PathDerivativeBounds: bounds of |q'|, |q''| and |q'''| of every axis over a part of the path. The jerk-limited plan
// of bounded cost needs no more than these. Derivation: filtered_limits.cpp.
#pragma once

#include "splinefeed/s2_arc_length/cell.hpp"
#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"

namespace splinefeed {

/// Largest derivatives of one axis by the path length s.
template <Scalar S>
struct AxisDemand {
    S first{};         ///< |dq/ds|
    S second{};        ///< |d2q/ds2| [1/mm]
    S third_with{};    ///< |d3q/ds3| where it has the sign of the second derivative [1/mm^2]
    S third_against{}; ///< |d3q/ds3| where it has the opposite sign
};

template <Scalar S>
struct PathDerivativeBounds {
    static constexpr int steepest_log2 = 29; ///< derivatives above this count as infinite

    PerAxis<AxisDemand<S>> axis{};
    S cap_sq = largest<S>();        ///< smallest cap of v^2
    S programmed_sq = largest<S>(); ///< smallest programmed feed, squared
    bool beyond = false;            ///< some derivative does not fit in the scalar: this part of the path is passed at
                                    ///< crawling speed

    /// The bounds of one cell. @param cap_sq, programmed_sq  of that cell
    [[nodiscard]] static PathDerivativeBounds of(const Cell<S>& cell, S cap_sq, S programmed_sq) noexcept;
    /// Makes the bounds valid for both parts of the path.
    void join(const PathDerivativeBounds& other, int axes) noexcept;
};

} // namespace splinefeed
