// SPDX-License-Identifier: MIT
// Smoothing of a chain: where a spline through its points may pass, so that its third derivative is small.
#pragma once

#include "splinefeed/s1_blended_path/chain_points.hpp"

namespace splinefeed {

/// Prepares what smooth_point() needs of the last point and of the one before it: the third difference that ends there,
/// and the ball around the point before. The ball lies towards the inside of the bend, so that vertices and the middles
/// of lines are equally far from the spline. Cost: a dozen divisions.
template <Scalar S>
void measure_last_point(ChainPoints<S>& points, S tolerance) noexcept;

/// Moves a point to where the sum of the squared third divided differences is smallest while its neighbours stay, and
/// from there into its ball. One such step is exact: the matrix of that sum has seven bands and is the same for all
/// axes. @pre an inner point
template <Scalar S>
void smooth_point(ChainPoints<S>& points, std::uint64_t i) noexcept;

} // namespace splinefeed
