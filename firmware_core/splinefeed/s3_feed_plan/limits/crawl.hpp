// SPDX-License-Identifier: MIT
// crawl: a way so short that a motion from rest to rest has no digits for its speed.
#pragma once

#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"

namespace splinefeed {

/// Segment durations, at least one, in which a way is travelled at one speed, so slow that no axis breaks its
/// acceleration or its jerk whatever the path does. @pre way_mm is a micrometre or less, and `limits` have a jerk limit
template <Scalar S>
[[nodiscard]] S crawling_ticks(S way_mm, const MotionLimits<S>& limits) noexcept;

} // namespace splinefeed
