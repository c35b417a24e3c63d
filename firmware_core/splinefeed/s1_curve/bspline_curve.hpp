// SPDX-License-Identifier: MIT
// BSplineCurve: a uniform B-spline with the waypoints as control points. It approximates the waypoints.
#pragma once

#include "splinefeed/s1_curve/waypoint_curve.hpp"
#include "splinefeed/splines/boehm.hpp"

namespace splinefeed {

/// Degree 3 is C2 in the knot parameter, degree 2 is C1; corners break the curve. A cubic joint with d_{i+1} = d_{i-1}
/// is a cusp (r' = 0). The curve stays in the convex hull of degree + 1 successive waypoints and passes only through
/// the ends of a run.
///
/// A run ends at a corner: the curve is clamped there, passes through the corner and stops. A run with fewer than
/// degree + 1 waypoints gets a lower degree: a parabola or a line. The base class merges coincident waypoints, so a
/// waypoint that is given twice does not pull the curve towards it. The parameterization is always uniform, whatever
/// the options say. The curve of a run with n + 1 waypoints has n + 1 - degree segments. A segment runs along one side
/// of the polygon and reports the waypoint where that side ends (degree 2: the waypoint at the segment's vertex).
/// The last segment reports the waypoint of the corner.
///
/// Local: a cubic segment needs three waypoints after the side that it runs along, a quadratic segment two after its
/// vertex. Source: handbook 4.1 (splines/boehm.hpp). Cost per waypoint: three divisions per axis.
template <Scalar S>
class BSplineCurve final : public WaypointCurve<S> {
public:
    /// @param degree 2 or 3
    BSplineCurve(const CurveOptions<S>& options, int degree) noexcept : WaypointCurve<S>(options), degree_(degree) {
        SPLINEFEED_ASSERT(degree == 2 || degree == 3);
    }
    Pull next(CurveSegment<S>& out) noexcept override;

private:
    [[nodiscard]] bool wanted(std::uint64_t at, int degree) const noexcept;
    void emit(std::uint64_t end, int degree, CurveSegment<S>& out) const noexcept;

    int degree_;
    std::uint64_t first_ = 0; ///< first knot of the run
    std::uint64_t next_ = 0;  ///< first vertex of the next segment
};

} // namespace splinefeed
