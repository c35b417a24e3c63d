// SPDX-License-Identifier: MIT
// crawl: travels a distance that is so short that a move from standstill to standstill has no digits for its speed.
#pragma once

#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"

namespace splinefeed {

/// Number of segment durations, at least one, in which a distance is travelled at one speed. The speed is so low that
/// no axis exceeds its acceleration or its jerk, whatever the path does. @pre way_mm is a micrometre or less, and
/// `limits` have a jerk limit
template <Scalar S>
[[nodiscard]] S crawling_ticks(S way_mm, const MotionLimits<S>& limits) noexcept;

} // namespace splinefeed
