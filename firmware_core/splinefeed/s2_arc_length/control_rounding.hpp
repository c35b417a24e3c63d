// SPDX-License-Identifier: MIT
// ControlRounding: what the rounding of control points does to the direction and to the curvature of a cell.
#pragma once

#include "splinefeed/s1_curve/curve_segment.hpp"

namespace splinefeed {

/// Of each axis, for a cell of a segment. Derivation: control_rounding.cpp. Cost: a few products an axis.
template <Scalar S>
struct ControlRounding {
    PerAxis<S> jump{}; ///< of dq/dt from one cell to the next, times 1/v
    PerAxis<S> bend{}; ///< of d2q/ds2, times the length of the cell

    /// @param level  halvings of the segment; `slowest`  smallest |dr/dw| in the cell, in units of the segment;
    /// `tangent_max`  bound of |dq/ds| in it
    [[nodiscard]] static ControlRounding of(const CurveSegment<S>& segment, int level, S slowest,
                                            const PerAxis<S>& tangent_max) noexcept;
    /// Largest speed along the path at which no axis's speed jumps by more than `jump_mm_s` where two cells meet.
    [[nodiscard]] S steady_speed(const PerAxis<S>& jump_mm_s, int axes) const noexcept;
};

} // namespace splinefeed
