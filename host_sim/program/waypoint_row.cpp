// SPDX-License-Identifier: MIT
#include "host_sim/program/waypoint_row.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/config/path_tolerances.hpp"

#include <fmt/format.h>

namespace splinefeed::host {

namespace {

constexpr double longest_move_mm = 65536.0;
constexpr double slowest_feed = 0.001;
constexpr double fastest_feed = 10000.0;

} // namespace

std::string position_refusal(std::string_view name, double mm, std::string_view shown) {
    return position_representable(mm)
               ? std::string()
               : fmt::format("{} {} is out of range; a position must lie within +-1048576 mm", name, in_quotes(shown));
}

std::string feed_refusal(std::string_view name, double mm_s, std::string_view shown) {
    return mm_s >= slowest_feed && mm_s <= fastest_feed
               ? std::string()
               : fmt::format("{} {} is out of range; it must lie between {} and {} mm/s", name, in_quotes(shown),
                             slowest_feed, fastest_feed);
}

std::string tolerance_refusal(double mm, std::string_view shown) {
    return mm >= 0.0 && mm <= largest_tolerance_mm
               ? std::string()
               : fmt::format("tolerance {} is out of range; it must lie between 0 and {} mm", in_quotes(shown),
                             largest_tolerance_mm);
}

std::string move_refusal(std::string_view name, double from_mm, double to_mm) {
    return to_mm - from_mm > longest_move_mm || from_mm - to_mm > longest_move_mm
               ? fmt::format("{} moves from {} to {} mm; two successive waypoints must be at most {} mm apart", name,
                             from_mm, to_mm, longest_move_mm)
               : std::string();
}

} // namespace splinefeed::host
