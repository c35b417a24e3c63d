// SPDX-License-Identifier: MIT
// leg_attempts: plans a leg with the expected speeds, and with lower ones if that gives no motion.
#pragma once

#include "splinefeed/s3_feed_plan/jerk_optimal/jerk_leg.hpp"

namespace splinefeed {

/// Plans a leg (JerkLeg) from the state of its first node (b = 0: standstill) to standstill at its end. Returns false
/// if no attempt found a motion. It reads at_most_sq and expected_sq of the nodes, and changes expected_sq. Cost: at
/// most six legs, usually one.
/// @param known  number of nodes that have a state of an earlier plan
[[nodiscard]] bool plan_leg(std::span<JerkNode> nodes, std::size_t known) noexcept;

} // namespace splinefeed
