// SPDX-License-Identifier: MIT
// cell_part: makes a cell of a part of a cell. Derivation: cell_part.cpp.
#pragma once

#include "splinefeed/s2_arc_length/cell.hpp"
#include "splinefeed/s2_arc_length/cell_interval.hpp"

namespace splinefeed {

/// Returns the part as a cell: the same curve, to the rounding of its polynomials, with the bounds of the whole cell.
/// If the cell has a stop at its end, so has a part that ends there. Otherwise `end` is the end of the part.
/// @pre 0 <= stretch.from < stretch.to <= 1. Cost: about 20 + 10 products per axis for a cubic.
template <Scalar S>
[[nodiscard]] Cell<S> part_of(const Cell<S>& cell, const CellInterval<S>& stretch) noexcept;

} // namespace splinefeed
