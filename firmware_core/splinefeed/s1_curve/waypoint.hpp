// SPDX-License-Identifier: MIT
// Waypoint: what the user's file holds, one point of the path.
#pragma once

#include "splinefeed/base/capacity.hpp"
#include "splinefeed/number/position.hpp"
#include "splinefeed/number/scalar.hpp"

#include <cstdint>

namespace splinefeed {

/// Whether the curve is broken (and the feed zero) at a waypoint.
enum class Corner : std::uint8_t {
    automatic, ///< where the path turns by more than the corner angle
    forced,
    forbidden,
};

/// A point of the path. Positions are exact integers, the same for every scalar.
template <Scalar S>
struct Waypoint {
    PerAxis<Position> position{};
    S feed_mm_s{}; ///< programmed feed of the move that ends here; 0: the machine's max_feed_mm_s
    Corner corner = Corner::automatic;
    S max_feed_mm_s{}; ///< no feed override takes that move beyond it, e.g. by the spindle's speed; 0: no such limit
};

/// What a pushed waypoint is for. A closed curve is streamed as lead-in (the points before the seam), path, lead-out
/// (the points after it): the outer two shape the curve at the seam and are not travelled.
enum class Role : std::uint8_t { lead_in, path, lead_out };

} // namespace splinefeed
