// SPDX-License-Identifier: MIT
// ControlPointStream: streaming interpolation of waypoints by a cubic spline; its control points are committed one by
// one. It is the common part of G2Spline and G2Bezier, which differ in how neighbouring pieces are joined: the Joints.
//
// It commits control points, not segments or tangents. The joints are G2 (C2 if they are plain) for any control points.
// So the limited look-ahead can only cause a small distance between curve and waypoint, never a kink. In float it
// commits tangents where their ratios are those of the spans: control points beside a long span would be too coarse for
// a short one.
// Derivation: control_point_stream.cpp.
#pragma once

#include "splinefeed/s1_curve/waypoint_curve.hpp"

namespace splinefeed {

/// End tangents of the whole curve. An end without a tangent is natural (zero second derivative). A tangent is in units
/// of the end chord: a unit vector along the chord gives the natural speed.
template <Scalar S>
struct EndTangents {
    bool has_start = false;
    bool has_end = false;
    PerAxis<S> start{};
    PerAxis<S> end{};
};

/// The knot spans around knot i, h_{i-2} to h_{i+1}; 0 outside the run. Each outer span is multiplied by gamma of the
/// joint between it and knot i. Only their ratios matter.
template <Scalar S>
struct SpansAround {
    S outer_before{};
    S before{};
    S after{};
    S outer_after{};
    S gamma{}; ///< gamma of knot i; not used if joints are plain
};

/// Joints of a B-spline: C2 in the knot parameter.
template <Scalar S>
struct PlainJoints {
    static constexpr bool weighted = false;
    [[nodiscard]] static constexpr bool by_spans() noexcept { return true; }
    [[nodiscard]] static constexpr S tension(S /*spacing*/) noexcept { return S{}; }
    [[nodiscard]] static SpansAround<S> around(S outer_before, S before, S after, S outer_after) noexcept {
        return {outer_before, before, after, outer_after, S{}};
    }
};

/// Joints of a gamma-spline (Boehm's form of beta joints). The ratio of the spans is beta1, and
///   gamma_i = 2 (h_{i-1} + h_i) / (nu_i h_{i-1} h_i + 2 (h_{i-1} + h_i)),  nu_i = beta2 h_{i-1} / h_i^2.
/// A leg of the control polygon is divided in the ratio gamma_{i-1} h_{i-2} : h_{i-1} : gamma_i h_i.
template <Scalar S>
struct BetaJoints {
    static constexpr bool weighted = true;
    bool span_ratio = true;       ///< beta1 is the ratio of the knot spans (chordal: of the chords)
    S beta1 = from_integer<S>(1); ///< if span_ratio is false: beta1 of every joint
    S beta2{};                    ///< tension of every joint, 0 to 1000

    /// Whether a curve with these joints is stable: beta1 between 1/8 and 8, and beta1^3 + 1 <= 2 beta1^2 + 2 beta1 +
    /// beta2 / 2; without tension that is 0.382 to 2.618. Outside this range tangents grow from joint to joint.
    [[nodiscard]] Status check() const noexcept;
    /// Whether neighbouring tangents are in the ratio of the spans.
    [[nodiscard]] bool by_spans() const noexcept { return span_ratio; }
    /// beta2 r omega / 2, which tension adds to the diagonal of a joint's row of tangents.
    [[nodiscard]] S tension(S r_omega) const noexcept { return scale2(beta2, -1) * r_omega; }
    [[nodiscard]] SpansAround<S> around(S outer_before, S before, S after, S outer_after) const noexcept;

private:
    [[nodiscard]] S gamma(S span, S next) const noexcept;
};

/// Look-ahead: 16 waypoints after the end of the segment. Cost per waypoint: one elimination step (one division by the
/// pivot) and 14 steps of back-substitution per axis.
template <Scalar S, class Joints>
class ControlPointStream : public WaypointCurve<S> {
public:
    static constexpr int look_ahead = 16; ///< waypoints known after the end of a segment when it is committed

    Pull next(CurveSegment<S>& out) noexcept final;

protected:
    ControlPointStream(const CurveOptions<S>& options, const EndTangents<S>& tangents, const Joints& joints) noexcept
        : WaypointCurve<S>(options), tangents_(tangents), joints_(joints) {}
    ~ControlPointStream() = default;

private:
    /// Row i of the eliminated system, delta_i = rho - gamma delta_{i+1}, and what the Bezier points need.
    struct Row {
        PerAxis<S> rho{};
        PerAxis<S> delta{}; ///< committed offset of control point i from waypoint i; by tangents: t_i
        S gamma{};
        S lambda{}; ///< weight of d_{i-1} in the Bezier point before knot i
        S mu{};     ///< weight of d_{i+1} in the Bezier point after knot i; by tangents: beta1 of knot i
        S omega{};  ///< weight of the Bezier point after knot i in the joint
    };
    [[nodiscard]] Row& row(std::uint64_t i) noexcept { return rows_[i % WaypointCurve<S>::capacity]; }
    /// Whether tangents are committed instead of control points: in float, if their ratios are those of the spans.
    [[nodiscard]] bool by_tangents() const noexcept {
        if constexpr (std::same_as<S, float>) {
            return joints_.by_spans();
        } else {
            return false;
        }
    }

    void eliminate_tangent(std::uint64_t i) noexcept;
    bool eliminate_row(std::uint64_t i) noexcept;
    void commit(std::uint64_t end) noexcept;
    void close_seam(std::uint64_t i) noexcept;
    void emit(std::uint64_t i, CurveSegment<S>& out) noexcept;

    EndTangents<S> tangents_;
    [[no_unique_address]] Joints joints_;
    std::array<Row, WaypointCurve<S>::capacity> rows_{};
    std::array<PerAxis<S>, 3> seam_{}; ///< offsets of the control points next to the seam of a closed curve
    PerAxis<S> joint_{};               ///< offset of the joint at the start of the next segment from its waypoint
    std::uint64_t next_ = 0;           ///< next segment to emit
    std::uint64_t first_ = 0;          ///< first knot of the run that is being eliminated
    std::uint64_t rows_end_ = 0;       ///< rows before this one are eliminated
    std::uint64_t committed_ = 0;      ///< offsets before this one are committed
    bool seam_known_ = false;
};

} // namespace splinefeed
