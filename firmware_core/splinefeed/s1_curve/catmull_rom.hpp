// SPDX-License-Identifier: MIT
// CatmullRom: cubic Hermite segments; their tangents are central differences of the waypoints.
#pragma once

#include "splinefeed/s1_curve/waypoint_curve.hpp"
#include "splinefeed/splines/catmull_rom_points.hpp"

namespace splinefeed {

/// Catmull-Rom curve with tension.
///
/// Uniform: r'(P_i) = m (P_{i+1} - P_{i-1}), Borysenko & Ustenko (3). Their printed b_x has the wrong sign at m (x3 -
/// x1), see the docs. m = 1/2 is the classical curve. Chordal and centripetal: the derivative of the parabola through
/// three points with spans h_{i-1}, h_i: r' = (h_i e_{i-1}/h_{i-1} + h_{i-1} e_i/h_i) / (h_{i-1} + h_i), times 2 m
/// (Barry & Goldman). Both agree for equal spans. At the ends the end points count twice: r' = m e / h. Class C1 in the
/// knot parameter: the curvature jumps at waypoints. Interpolates. Local: one waypoint of look-ahead. The arithmetic is
/// that of catmull_rom_tangent and catmull_rom_legs; the uniform curve equals that of catmull_rom_points bit for bit.
template <Scalar S>
class CatmullRom final : public WaypointCurve<S> {
public:
    /// @param tension m, 0 (polygon) to 10; 1/2 is the classical curve
    CatmullRom(const CurveOptions<S>& options, S tension) noexcept : WaypointCurve<S>(options), tension_(tension) {}
    Pull next(CurveSegment<S>& out) noexcept override;

private:
    /// The tangent at knot i, from the chords on those sides that belong to the run.
    void find_tangent(std::uint64_t i, bool from_before, bool from_after, KnotTangent<S>& out) const noexcept;

    S tension_;
    std::array<KnotTangent<S>, 2> tangents_{}; ///< tangent of knot i at index [i % 2]
    std::uint64_t ends_at_ = 0;                ///< the knot where the last segment ended and the next one starts
    std::uint64_t next_ = 0;
};

} // namespace splinefeed
