// SPDX-License-Identifier: MIT
// cell_part: a stretch of a cell as a cell of its own. Derivation: cell_part.cpp.
#pragma once

#include "splinefeed/s2_arc_length/cell.hpp"
#include "splinefeed/s2_arc_length/cell_interval.hpp"

namespace splinefeed {

/// The same curve, to the rounding of its polynomials; bounds are those of all of the cell. A stop at the cell's end is
/// one of the part that ends there; elsewhere `end` is where the part ends.
/// @pre 0 <= stretch.from < stretch.to <= 1. Cost: about 20 + 10 products an axis for a cubic.
template <Scalar S>
[[nodiscard]] Cell<S> part_of(const Cell<S>& cell, const CellInterval<S>& stretch) noexcept;

} // namespace splinefeed
