// SPDX-License-Identifier: MIT
// SmoothedCurve: turns a chain of segments that meet with a common tangent (C1, G1) into a G2 curve.
#pragma once

#include "splinefeed/s1_curve/curve_source.hpp"

namespace splinefeed {

/// What the source delivers at its ends.
enum class Seam : std::uint8_t {
    open,     ///< only the curve; its ends keep their own curvature
    repeated, ///< a closed curve with its last segment before the first and its first after the last: these two shape
              ///< the seam and are not delivered. WaypointCurve does this with CurveOptions::seam_segments
};

/// Takes segments of degree 5 or less from a source and smooths them. Where two segments meet in one direction, both
/// get the same unit tangent and the same curvature vector: the mean of their curvatures, weighted by the squares of
/// the tangents,
///     K = (n_a^2 K_a + n_b^2 K_b)/(n_a^2 + n_b^2),  n = |r'|.
/// For equal tangents this is the plain mean. It moves both segments by the same amount, and never by more than the
/// shorter segment allows, however long the other is. The plain mean would move a 100 mm line beside a 1 mm arc
/// by 86 mm. Each segment becomes a quintic that keeps its end points, its tangent lengths and the tangential parts of
/// its second derivatives, and has the normal parts K |r'|^2.
///
/// Class G2 at these joints; in the parameter as before (C1 stays C1). Joints are left alone where the machine stops
/// (stop_at_end) and where the direction jumps (by more than 2^-10). So they are where a tangent vanishes (below 2^-16
/// of its segment: no direction, no curvature), and where both segments are lines. The last case is where the common
/// curvature would move a segment by its own size (beside a near-cusp). A segment is delivered unchanged if both its
/// joints are left alone. Deviation from the source: at most 0.018 |K - K_a| n_a^2 per end (Hermite's quintic basis
/// functions of the second derivative are at most 0.01728). That is 0.018 n_a^2 n_b^2/(n_a^2 + n_b^2) times the jump of
/// the curvature. Available if SPLINEFEED_MAX_DEGREE is at least 5. Look-ahead: one segment. Cost: two square roots and
/// a division per axis and joint, and 30 products per axis.
template <Scalar S>
class SmoothedCurve final : public CurveSource<S> {
public:
    /// `source` must outlive it.
    explicit SmoothedCurve(CurveSource<S>& source, Seam seam = Seam::open) noexcept : source_(&source), seam_(seam) {}

    Pull next(CurveSegment<S>& out) noexcept override;

    /// Values of a segment at a joint, in the segment's own unit.
    struct End {
        bool shared = false;    ///< true: replaced by the members below
        PerAxis<S> tangent{};   ///< r', along the shared direction
        PerAxis<S> curvature{}; ///< the normal part of r''
        PerAxis<S> direction{};
    };

private:
    void join() noexcept;
    void emit(CurveSegment<S>& out) const noexcept;

    CurveSource<S>* source_;
    Seam seam_;
    CurveSegment<S> current_{};
    CurveSegment<S> ahead_{};
    End start_{}; ///< of current_
    End end_{};
    End next_start_{}; ///< of ahead_
    bool has_current_ = false;
    bool lead_in_ = true; ///< current_ is the segment before the seam
    bool source_finished_ = false;
};

} // namespace splinefeed
