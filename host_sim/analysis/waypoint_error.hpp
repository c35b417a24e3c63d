// SPDX-License-Identifier: MIT
// WaypointError: how far the curve passes from its waypoints.
#pragma once

#include "splinefeed/s1_curve/curve_segment.hpp"

#include <cstdint>
#include <deque>

namespace splinefeed::host {

/// Takes waypoints and curve segments as they come, each in order, a waypoint before the segments that lead to it. A
/// waypoint is compared with the nearest points of the segments around it: those that lead to it and the first one
/// after it. A waypoint to which no segment leads was merged with its predecessor, and is compared with the same
/// segments. The result has no meaning for a method that does not pass through its points (bspline); the summary then
/// says so. Memory: the waypoints that no segment has reached yet (the look-ahead of the curve). Cost: about 1 us per
/// segment.
class WaypointError {
public:
    /// Index as in CurveSegment::waypoint, increasing modulo 2^32.
    void waypoint(std::uint32_t index, const PerAxis<Position>& position);

    void segment(const CurveSegment<double>& segment);

    /// Largest distance of the waypoints that the curve has reached so far. 0 without waypoints.
    [[nodiscard]] double largest_mm() const noexcept;

private:
    struct Pending {
        std::uint32_t index;
        PerAxis<Position> position;
        double merged_mm; ///< largest distance of the waypoints that were merged into this one
    };
    /// A segment in double: offsets from `origin` in mm.
    struct Piece {
        int axes = 0;
        int degree = 0;
        PerAxis<Position> origin{};
        PerAxis<PerDegree<double>> offset{};

        [[nodiscard]] double distance_mm(const PerAxis<Position>& position) const noexcept;
    };

    void advance(const Piece& piece, std::uint32_t waypoint);

    std::deque<Pending> pending_;
    Piece last_{};
    std::uint32_t last_waypoint_ = 0;
    bool any_segment_ = false;
    double largest_mm_ = 0.0;
};

} // namespace splinefeed::host
