// SPDX-License-Identifier: MIT
// leg_attempts: a leg is planned with what is expected of it, and where that leads to no motion with less.
#pragma once

#include "splinefeed/s3_feed_plan/jerk_optimal/jerk_leg.hpp"

namespace splinefeed {

/// Plans a leg (JerkLeg) from the state of its first node (b = 0: from rest) to rest at its end. Returns false where no
/// attempt found a motion. Of its nodes at_most_sq and expected_sq are read, and expected_sq is changed.
/// @param known  that many nodes have a state of an earlier plan
/// Cost: at most six legs, as a rule one.
[[nodiscard]] bool plan_leg(std::span<JerkNode> nodes, std::size_t known) noexcept;

} // namespace splinefeed
