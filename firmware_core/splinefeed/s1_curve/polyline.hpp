// SPDX-License-Identifier: MIT
// Polyline: straight lines through the waypoints, with a full stop at every corner. Collinear points cause no stop.
#pragma once

#include "splinefeed/s1_curve/waypoint_curve.hpp"

namespace splinefeed {

/// Class C0. Interpolates. Local: no look-ahead beyond the next point. Cost per waypoint: constant.
template <Scalar S>
class Polyline final : public WaypointCurve<S> {
public:
    explicit Polyline(const CurveOptions<S>& options) noexcept : WaypointCurve<S>(options) {}
    Pull next(CurveSegment<S>& out) noexcept override;

private:
    std::uint64_t next_ = 0;
};

} // namespace splinefeed
