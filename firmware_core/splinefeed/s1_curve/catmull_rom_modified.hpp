// SPDX-License-Identifier: MIT
// CatmullRomModified: the modified Catmull-Rom curve, streaming.
#pragma once

#include "splinefeed/s1_curve/waypoint_curve.hpp"
#include "splinefeed/splines/catmull_rom_modified.hpp"

namespace splinefeed {

/// Tangents are derivatives by chord length of the parabola through three waypoints: Borysenko & Ustenko as corrected
/// in splines/catmull_rom_modified.hpp, whose arithmetic it shares: bit by bit the same curve. Runs end at corners with
/// one-sided differences. Class within a run: C1 by chord length, G1 by the segment's parameter (ChordFactor::chord),
/// C1 (constant); the curvature jumps at waypoints. Interpolates; local: one waypoint of look-ahead.
/// CurveOptions::parameterization has no meaning here: it is chord length.
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
    /// R'(s) at an end of segment i, seen from it.
    [[nodiscard]] Point<S> start_slope(std::uint64_t i) const noexcept;
    [[nodiscard]] Point<S> end_slope(std::uint64_t i) const noexcept;

    ModifiedTangents<S> tangents_; ///< lengths in chord units
    std::uint64_t next_ = 0;
};

} // namespace splinefeed
