// SPDX-License-Identifier: MIT
// WaypointRow: one waypoint as an input states it, and what its numbers may be.
#pragma once

#include "host_sim/program/row_source.hpp"
#include "splinefeed/s1_curve/waypoint.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace splinefeed::host {

/// In mm and mm/s.
struct WaypointRow {
    PerAxis<double> position{}; ///< axes without a column are 0
    double feed_mm_s = 0.0;     ///< 0: the machine's feed
    double max_feed_mm_s = 0.0; ///< 0: no limit
    Corner corner = Corner::automatic;
    std::optional<double> tolerance_mm{}; ///< of the move that ends here
    std::uint64_t line = 0;
};

// What is wrong with a number, one sentence; empty: nothing. NaN and infinity are out of range.

/// @param name  of the axis   @param shown  the number as the user knows it
[[nodiscard]] std::string position_refusal(std::string_view name, double mm, std::string_view shown);
/// @param name  feed or max_feed
[[nodiscard]] std::string feed_refusal(std::string_view name, double mm_s, std::string_view shown);
[[nodiscard]] std::string tolerance_refusal(double mm, std::string_view shown);
/// Of the way from one waypoint to the next. @param name  of the axis
[[nodiscard]] std::string move_refusal(std::string_view name, double from_mm, double to_mm);

/// A source of waypoints, in order.
using WaypointRows = RowSource<WaypointRow>;

} // namespace splinefeed::host
