// SPDX-License-Identifier: MIT
// The direction and the curvature of a chain at one of its points.
#pragma once

#include "splinefeed/s1_blended_path/chain_points.hpp"
#include "splinefeed/s1_blended_path/path_state.hpp"

namespace splinefeed {

/// Those of the cubic spline over chord length through the smoothed points, of which it takes five on either side. The
/// spline has no curvature at the ends of the chain. The offset of the state is zero. Cost: 11 square roots, and a
/// dozen products and two divisions for each point and axis.
template <Scalar S>
void chain_state(const ChainPoints<S>& points, std::uint64_t at, PathState<S>& out) noexcept;

} // namespace splinefeed
