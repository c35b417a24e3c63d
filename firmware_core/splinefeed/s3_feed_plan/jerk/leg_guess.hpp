// SPDX-License-Identifier: MIT
// leg_guess: a motion along a leg that is close to the limits, as a start for LegSolver.
#pragma once

#include "splinefeed/s3_feed_plan/jerk/leg_node.hpp"

#include <span>

namespace splinefeed {

/// Sets middle_sq of the cells from likely_sq, by two envelopes. Derivation: leg_guess.cpp. Cost: two roots, a cube
/// root and thirty operations a node.
/// @param nodes  one more than cells
/// @param rests  it begins at standstill; otherwise with b and slope of the first node
template <Floating R>
void guess_leg(std::span<LegNode<R>> nodes, const AxisLimits<R>& limits, bool rests) noexcept;

/// Leads from known_sq of the first `known` cells to middle_sq, smoothly over the part of their length behind `from`.
/// @pre known > 1
template <Floating R>
void lead_over(std::span<LegNode<R>> nodes, std::size_t known, R from) noexcept;

} // namespace splinefeed
