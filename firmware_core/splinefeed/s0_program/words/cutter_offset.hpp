// SPDX-License-Identifier: MIT
// CutterOffset: on which side of a contour a tool travels, and how far from it.
#pragma once

#include "splinefeed/s0_program/words/plane_vector.hpp"

namespace splinefeed {

/// How a tool is offset from a contour.
struct CutterOffset {
    Plane plane = Plane::xy;
    int side = 0;     ///< 1: left of the contour, -1: right, 0: not at all
    Decimal radius{}; ///< of the tool [mm]; 0: the contour is its path
    /// From the middle of a lathe tool's tip to the point that is programmed.
    PlanePoint tip{};

    [[nodiscard]] constexpr bool applies() const noexcept { return side != 0 && radius.raw > 0; }
    friend constexpr bool operator==(const CutterOffset&, const CutterOffset&) noexcept = default;
};

} // namespace splinefeed
