// SPDX-License-Identifier: MIT
// Waypoint: one point of the path, as the user's file gives it.
#pragma once

#include "splinefeed/base/capacity.hpp"
#include "splinefeed/number/position.hpp"
#include "splinefeed/number/scalar.hpp"

#include <cstdint>

namespace splinefeed {

/// Whether a waypoint is a corner: the curve is broken there and the feed is zero.
enum class Corner : std::uint8_t {
    automatic, ///< a corner if the path turns by more than the corner angle
    forced,
    forbidden,
};

/// A point of the path. Positions are exact integers, the same for every scalar type.
template <Scalar S>
struct Waypoint {
    PerAxis<Position> position{};
    S feed_mm_s{}; ///< programmed feed of the move that ends here; 0: the machine's max_feed_mm_s
    Corner corner = Corner::automatic;
    S max_feed_mm_s{}; ///< upper limit for every feed override of that move, e.g. because of the spindle's speed; 0: no
                       ///< limit
};

/// What a pushed waypoint is for. A closed curve is streamed as lead-in (the points before the seam), path, and
/// lead-out (the points after it). Lead-in and lead-out shape the curve at the seam and are not travelled.
enum class Role : std::uint8_t { lead_in, path, lead_out };

} // namespace splinefeed
