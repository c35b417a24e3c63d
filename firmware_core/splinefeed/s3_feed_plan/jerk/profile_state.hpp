// SPDX-License-Identifier: MIT
// profile_state: speed and acceleration at a place on a profile segment with limited jerk.
#pragma once

#include "splinefeed/s3_feed_plan/jerk/speed_state.hpp"
#include "splinefeed/s3_feed_plan/motion_plan.hpp"

namespace splinefeed {

/// @param fraction  fraction of the cell's length where the machine is
/// @param time_share  fraction of the profile segment's time at that place
/// @pre SpeedShape::parabola over the whole cell, or SpeedShape::cubic
template <Scalar X>
[[nodiscard]] SpeedState state_on(const ProfileSegment<X>& profile_segment, double cell_length_mm, double fraction,
                                  double time_share) noexcept;

} // namespace splinefeed
