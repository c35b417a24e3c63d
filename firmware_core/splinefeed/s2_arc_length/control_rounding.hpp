// SPDX-License-Identifier: MIT
// ControlRounding: the effect of rounded control points on the direction and the curvature of a cell.
#pragma once

#include "splinefeed/s1_curve/curve_segment.hpp"

namespace splinefeed {

/// The effect on each axis, for a cell of a segment. Derivation: control_rounding.cpp. Cost: a few products per axis.
template <Scalar S>
struct ControlRounding {
    PerAxis<S> jump{}; ///< jump of dq/dt from one cell to the next, times 1/v
    PerAxis<S> bend{}; ///< error of d2q/ds2, times the length of the cell

    /// @param level    number of halvings of the segment
    /// @param slowest  smallest |dr/dw| in the cell, in units of the segment; `tangent_max`: bound of |dq/ds| in the
    ///                 cell
    [[nodiscard]] static ControlRounding of(const CurveSegment<S>& segment, int level, S slowest,
                                            const PerAxis<Ratio<S>>& tangent_max) noexcept;
    /// Largest speed along the path at which no axis's speed jumps by more than `jump_mm_s` where two cells meet.
    [[nodiscard]] S steady_speed(const PerAxis<S>& jump_mm_s, int axes) const noexcept;
};

} // namespace splinefeed
