// SPDX-License-Identifier: MIT
// move_extent: the box that a programmed move lies in, and its length.
#pragma once

#include "splinefeed/s1_blended_path/path_element.hpp"

namespace splinefeed::host {

/// The smallest and the largest position of each axis. [mm, degrees]
struct AxisBox {
    PerAxis<double> low{};
    PerAxis<double> high{};
    bool empty = true;

    void add(unsigned axis, double from, double to) noexcept;
};

/// Adds a move to a box. Lines and arcs are exact, helices and arcs of several turns, too; of a Bezier segment it is
/// the box of its control points, which may be larger than the move.
void add_extent(const PerAxis<Position>& from, const PathElement<double>& move, int axes, AxisBox& box) noexcept;

/// Length over the first `axes` axes of which `counts` is true [mm]; of an arc x, y and z always count. Bezier segments
/// within 0.1 %.
[[nodiscard]] double move_length(const PerAxis<Position>& from, const PathElement<double>& move, int axes,
                                 const PerAxis<bool>& counts) noexcept;

} // namespace splinefeed::host
