// SPDX-License-Identifier: MIT
// profile_state: what the machine does where it is on a profile segment with limited jerk.
#pragma once

#include "splinefeed/s3_feed_plan/jerk_optimal/state_polygon.hpp"
#include "splinefeed/s3_feed_plan/steering/motion_plan.hpp"

namespace splinefeed {

/// @param fraction  of the cell's length, where the machine is
/// @param time_share  fraction of the profile segment's time, then
/// @pre SpeedShape::parabola over all of the cell, or SpeedShape::cubic
template <Scalar S>
[[nodiscard]] SpeedState state_on(const ProfileSegment<S>& profile_segment, double cell_length_mm, double fraction,
                                  double time_share) noexcept;

} // namespace splinefeed
