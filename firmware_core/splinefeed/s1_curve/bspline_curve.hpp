// SPDX-License-Identifier: MIT
// BSplineCurve: a uniform B-spline whose control points are the waypoints; it approximates them.
#pragma once

#include "splinefeed/s1_curve/waypoint_curve.hpp"
#include "splinefeed/splines/boehm.hpp"

namespace splinefeed {

/// Degree 3: C2 in the knot parameter; degree 2: C1; broken at corners. A cubic joint with d_{i+1} = d_{i-1} is a cusp
/// (r' = 0). The curve stays in the hull of degree + 1 successive waypoints and passes only the ends of a run.
///
/// A run ends at a corner, clamped: the curve passes the corner and stops there. A run with fewer than degree + 1
/// waypoints gets the degree that it has waypoints for: a parabola, a line. Coincident waypoints are merged by the
/// base, so that doubling one does not draw the curve towards it. The parameterization is uniform whatever the options
/// say. The curve of a run with n + 1 waypoints has n + 1 - degree segments; a segment reports the waypoint where the
/// side that it runs along ends (degree 2: the one at its corner), the last one that of the corner.
///
/// Local: a cubic segment sees three waypoints past the side that it runs along, a quadratic one two past its vertex.
/// Source: handbook 4.1 (splines/boehm.hpp); cost per waypoint: three divisions per axis.
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
