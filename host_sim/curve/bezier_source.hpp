// SPDX-License-Identifier: MIT
// BezierSource: the segments of a curve file as a curve source, executed as they stand.
#pragma once

#include "host_sim/curve/curve_file.hpp"

#include "splinefeed/s1_curve/curve_source.hpp"

namespace splinefeed::host {

/// Control points are rounded once, from double to offsets from the exact end of the segment before: gaps up to
/// CurveFile::largest_gap_mm close there and do not add up. Segments within 1 nm of their start are left out.
template <Scalar S>
class BezierSource final : public CurveSource<S> {
public:
    /// @pre file.method is bezier; it outlives the source
    /// @param axes  of the machine, at least file.axes; those beyond stay at 0
    /// @param repeat_seam  for SmoothedCurve: a closed file's last segment comes before the first, too, and its first
    ///                     after the last
    BezierSource(const CurveFile& file, int axes, bool repeat_seam = false) noexcept;
    Pull next(CurveSegment<S>& out) noexcept override;
    /// Whether the seam is repeated: asked for, and the file's ends meet.
    [[nodiscard]] bool repeats_seam() const noexcept { return repeats_; }

private:
    [[nodiscard]] bool negligible(std::size_t segment) const noexcept;
    /// Of a segment that begins at here_; false where it is left out.
    bool deliver(std::size_t segment, CurveSegment<S>& out) noexcept;
    void go_to_start(std::size_t segment) noexcept;

    const CurveFile* file_;
    PerAxis<Position> here_{}; // the end of the segment before
    std::size_t next_ = 0;
    int axes_;
    bool repeats_ = false;
    bool before_seam_ = false; // the last segment is due, before the first
    bool after_seam_ = false;  // the first one is, after the last
};

} // namespace splinefeed::host
