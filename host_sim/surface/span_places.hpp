// SPDX-License-Identifier: MIT
// span_places: where to look at a surface so that no knot span is passed over.
#pragma once

#include "splinefeed/surfaces/bspline_surface.hpp"

#include <vector>

namespace splinefeed::host {

/// Parameters from `low` to `high`, both included, in the direction `along`. Every knot span between them is cut into
/// equal parts, at least `parts` of them, and more where the spans are so few that there were less than `total` in all.
/// @pre low < high, within the domain
[[nodiscard]] std::vector<double> span_places(const BSplineSurface<double>& surface, SurfaceDirection along, double low,
                                              double high, int parts, int total);

} // namespace splinefeed::host
