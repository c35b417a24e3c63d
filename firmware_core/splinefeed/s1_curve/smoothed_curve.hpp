// SPDX-License-Identifier: MIT
// SmoothedCurve: promotes a chain of segments that meet with a common tangent (C1, G1) to G2.
#pragma once

#include "splinefeed/s1_curve/curve_source.hpp"

namespace splinefeed {

/// What the source delivers around its ends.
enum class Seam : std::uint8_t {
    open,     ///< the curve; its ends keep their own curvature
    repeated, ///< a closed curve with its last segment before the first and its first after the last: these two shape
              ///< the seam and are not passed on. WaypointCurve does so with CurveOptions::seam_segments
};

/// Decorator of a source of segments of degree 5 at most. Where two segments meet in one direction, both get the same
/// unit tangent and the same curvature vector: the mean of theirs weighted by the squares of the tangents,
///     K = (n_a^2 K_a + n_b^2 K_b)/(n_a^2 + n_b^2),  n = |r'|,
/// which is the mean of equal tangents, moves both segments by the same amount and, by no more than the shorter one
/// allows, however long the other (the plain mean would throw a 100 mm line beside a 1 mm arc 86 mm off). A segment
/// becomes the quintic with its end points, its tangent lengths, the tangential parts of its second derivatives, and
/// normal parts K |r'|^2.
///
/// Class G2 at these joints, in parameter as before (C1 stays C1). Left alone are joints where the machine stops
/// (stop_at_end), where the direction jumps (by more than 2^-10), where a tangent vanishes (below 2^-16 of its segment:
/// no direction, no curvature), where both segments are lines, and where the common curvature would throw a segment
/// off by its own size (beside a near-cusp). A segment whose two joints are left alone is passed
/// on as it is. Deviation from the source: at most 0.018 |K - K_a| n_a^2 per end, (Hermite's quintic basis functions of
/// the second derivative are at most 0.01728): 0.018 n_a^2 n_b^2/(n_a^2 + n_b^2) times the jump.
/// Exists where SPLINEFEED_MAX_DEGREE is 5 at least. Look-ahead: one segment. Cost: two square roots and a division per
/// axis and joint, and 30 products per axis.
template <Scalar S>
class SmoothedCurve final : public CurveSource<S> {
public:
    /// `source` must outlive it.
    explicit SmoothedCurve(CurveSource<S>& source, Seam seam = Seam::open) noexcept : source_(&source), seam_(seam) {}

    Pull next(CurveSegment<S>& out) noexcept override;

    /// End conditions of a segment at a joint, in its own unit.
    struct End {
        bool shared = false;    ///< to be replaced by what follows
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
