// SPDX-License-Identifier: MIT
// span_places: places to check on a surface, with several in every knot span.
#pragma once

#include "splinefeed/surfaces/bspline_surface.hpp"

#include <vector>

namespace splinefeed::host {

/// Parameters from `low` to `high`, both included, in the direction `along`. Every knot span between them is divided
/// into equal parts: at least `parts`, and more if there would be less than `total` parts in all.
/// @pre low < high, within the domain
[[nodiscard]] std::vector<double> span_places(const BSplineSurface<double>& surface, SurfaceDirection along, double low,
                                              double high, int parts, int total);

} // namespace splinefeed::host
