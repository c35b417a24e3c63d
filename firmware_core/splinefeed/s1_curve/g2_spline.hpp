// SPDX-License-Identifier: MIT
// G2Spline: streaming interpolation of waypoints by a cubic B-spline; the default curve.
//
// What is committed are control points, never segments and never tangents: a cubic B-spline is C2 for any control
// points, so what the bounded look-ahead costs is a sub-nanometre miss at a waypoint and never a kink.
// Derivation: g2_spline.cpp.
#pragma once

#include "splinefeed/s1_curve/waypoint_curve.hpp"

namespace splinefeed {

/// End tangents of the whole curve; without one the end is natural (zero second derivative).
/// A tangent is in units of the end chord: the unit vector along it leaves at natural speed.
template <Scalar S>
struct EndTangents {
    bool has_start = false;
    bool has_end = false;
    PerAxis<S> start{};
    PerAxis<S> end{};
};

/// Class C2 in the knot parameter, hence G2, within a run; broken at corners. Interpolates (within 0.268^13 of the
/// local second difference for even spacing; 2e-8 mm measured on spacings of 1000:1). Look-ahead: 16 waypoints past the
/// end of the segment. Cost per waypoint: one elimination step (one division by the pivot) and 14 steps of
/// back-substitution per axis. Source: de Boor's interpolation conditions by blossoms; Schoenberg-Whitney holds, total
/// positivity makes elimination without pivoting stable.
template <Scalar S>
class G2Spline final : public WaypointCurve<S> {
public:
    static constexpr int look_ahead = 16; ///< waypoints seen past the end of a segment when it is committed

    explicit G2Spline(const CurveOptions<S>& options, const EndTangents<S>& tangents = {}) noexcept
        : WaypointCurve<S>(options), tangents_(tangents) {}
    Pull next(CurveSegment<S>& out) noexcept override;

private:
    /// Row i of the eliminated system: delta_i = rho - gamma delta_{i+1}; and what the Bezier points need.
    struct Row {
        PerAxis<S> rho{};
        PerAxis<S> delta{}; ///< committed offset of control point i from waypoint i
        S gamma{};
        S lambda{}; ///< weight of d_{i-1} in the Bezier point before knot i
        S mu{};     ///< weight of d_{i+1} in the Bezier point after knot i
        S omega{};  ///< weight of the point after in the joint
    };
    [[nodiscard]] Row& row(std::uint64_t i) noexcept { return rows_[i % WaypointCurve<S>::capacity]; }

    bool eliminate_row(std::uint64_t i) noexcept;
    void commit(std::uint64_t i) noexcept;
    void close_seam(std::uint64_t i) noexcept;
    void emit(std::uint64_t i, CurveSegment<S>& out) noexcept;

    EndTangents<S> tangents_;
    std::array<Row, WaypointCurve<S>::capacity> rows_{};
    std::array<PerAxis<S>, 3> seam_{}; ///< offsets of the control points around the seam of a closed curve
    PerAxis<S> joint_{};               ///< offset of the joint at the start of the next segment from its waypoint
    std::uint64_t next_ = 0;           ///< next segment to emit
    std::uint64_t first_ = 0;          ///< first knot of the run that is being eliminated
    std::uint64_t rows_end_ = 0;       ///< rows below are eliminated
    std::uint64_t committed_ = 0;      ///< offsets below are committed
    bool seam_known_ = false;
};

} // namespace splinefeed
