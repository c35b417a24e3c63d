// SPDX-License-Identifier: MIT
// CatmullRomModified: the streaming form of the modified Catmull-Rom curve.
#pragma once

#include "splinefeed/s1_curve/waypoint_curve.hpp"
#include "splinefeed/splines/catmull_rom_modified.hpp"

namespace splinefeed {

/// Each tangent is the derivative by chord length of the parabola through three waypoints: Borysenko & Ustenko, as
/// corrected in splines/catmull_rom_modified.hpp. It shares that arithmetic, and the curve is the same bit for bit.
/// Runs end at corners with one-sided differences. Class within a run: C1 by chord length, G1 by the segment's
/// parameter (ChordFactor::chord), C1 (constant); the curvature jumps at waypoints. Interpolates. Local: one waypoint
/// of look-ahead. CurveOptions::parameterization is ignored: this curve always uses chord length.
template <Scalar S>
class CatmullRomModified final : public WaypointCurve<S> {
public:
    /// @param factor  chord: a tension, 0 (polygon) to 2, usually 1; constant: a length in mm, 0 to 2^16
    CatmullRomModified(const CurveOptions<S>& options, S factor, ChordFactor mode = ChordFactor::chord) noexcept
        : WaypointCurve<S>(options), tangents_{mode, mode == ChordFactor::chord ? factor
                                                                                : scale2(factor, -chord_unit_log2)} {}
    Pull next(CurveSegment<S>& out) noexcept override;

private:
    [[nodiscard]] Chord<S> chord(std::uint64_t i) const noexcept;
    /// R'(s) at one end of segment i, computed from that segment.
    [[nodiscard]] Point<S> start_slope(std::uint64_t i) const noexcept;
    [[nodiscard]] Point<S> end_slope(std::uint64_t i) const noexcept;

    ModifiedTangents<S> tangents_; ///< lengths in chord units
    std::uint64_t next_ = 0;
};

} // namespace splinefeed
