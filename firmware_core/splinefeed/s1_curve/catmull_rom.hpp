// SPDX-License-Identifier: MIT
// CatmullRom: cubic Hermite segments whose tangents are central differences of the waypoints.
#pragma once

#include "splinefeed/s1_curve/waypoint_curve.hpp"
#include "splinefeed/splines/catmull_rom_points.hpp"

namespace splinefeed {

/// Catmull-Rom curve with tension.
///
/// Uniform: r'(P_i) = m (P_{i+1} - P_{i-1}), Borysenko & Ustenko (3); their printed b_x has the wrong sign of
/// m (x3 - x1), see docs; m = 1/2 is the classical curve. Chordal and centripetal: the derivative of the parabola
/// through three points at spans h_{i-1}, h_i, r' = (h_i e_{i-1}/h_{i-1} + h_{i-1} e_i/h_i) / (h_{i-1} + h_i), times 2
/// m (Barry & Goldman); both agree for equal spans. Ends by doubled end points: r' = m e / h. Class C1 in the knot
/// parameter: the curvature jumps at waypoints. Interpolates; local: one waypoint of look-ahead. The arithmetic is
/// catmull_rom_tangent and _legs: uniform, it is the curve of catmull_rom_points bit by bit.
template <Scalar S>
class CatmullRom final : public WaypointCurve<S> {
public:
    /// @param tension m, 0 (polygon) to 10; 1/2 is the classical curve
    CatmullRom(const CurveOptions<S>& options, S tension) noexcept : WaypointCurve<S>(options), tension_(tension) {}
    Pull next(CurveSegment<S>& out) noexcept override;

private:
    /// At knot i, of the chords on those sides that belong to the run.
    void find_tangent(std::uint64_t i, bool from_before, bool from_after, KnotTangent<S>& out) const noexcept;

    S tension_;
    std::array<KnotTangent<S>, 2> tangents_{}; ///< of knot i: [i % 2]
    std::uint64_t ends_at_ = 0;                ///< the knot where the last segment ended: the next one's start
    std::uint64_t next_ = 0;
};

} // namespace splinefeed
