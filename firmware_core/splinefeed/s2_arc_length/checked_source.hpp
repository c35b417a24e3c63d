// SPDX-License-Identifier: MIT
// CheckedSource: delivers the segments of a curve up to the first one that does not fit the machine.
#pragma once

#include "splinefeed/s1_curve/curve_source.hpp"
#include "splinefeed/s2_arc_length/cell.hpp"
#include "splinefeed/s2_arc_length/refinement.hpp"

namespace splinefeed {

/// Range of an axis's control points.
template <Scalar S>
[[nodiscard]] PositionRange hull(const PerDegree<S>& control, int degree, Position origin, int unit_log2) noexcept;

/// Whether the direction jumps by more than `most` between two segments. Also true if a tangent vanishes at the joint.
template <Scalar S>
[[nodiscard]] bool direction_jumps(const CurveSegment<S>& before, const CurveSegment<S>& after, S most) noexcept;

/// Whether a segment turns as if its mean radius were below this one. Cost: a root for each side of its control
/// polygon.
template <Scalar S>
[[nodiscard]] bool turns_within(const CurveSegment<S>& segment, S radius_mm) noexcept;

template <Scalar S>
class CheckedSource {
public:
    /// `source` and `refinement` must outlive it.
    CheckedSource(CurveSource<S>& source, const Refinement<S>& refinement) noexcept
        : source_(&source), refinement_(&refinement) {}

    /// Begins with another source. @param from  where it must begin, to 2^-26 mm; must outlive the call that writes the
    /// first segment. null: anywhere
    void start(CurveSource<S>& source, const PerAxis<Position>* from) noexcept {
        source_ = &source;
        from_ = from;
        status_ = {};
    }
    /// Writes the source's next segment. `finished` if that segment does not fit.
    Pull next(CurveSegment<S>& out) noexcept;
    /// Why the path ended before the end of its source: axes_differ, counts_out_of_range or start_elsewhere.
    [[nodiscard]] Status status() const noexcept { return status_; }

private:
    [[nodiscard]] Status check(const CurveSegment<S>& segment) const noexcept;

    CurveSource<S>* source_;
    const Refinement<S>* refinement_;
    const PerAxis<Position>* from_ = nullptr; // where the first segment must begin; null: anywhere, or it has begun
    Status status_{};
};

} // namespace splinefeed
