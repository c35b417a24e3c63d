// SPDX-License-Identifier: MIT
// BezierSource: the segments of a curve file as a curve source, executed unchanged.
#pragma once

#include "host_sim/curve/curve_file.hpp"

#include "splinefeed/s1_curve/curve_source.hpp"

namespace splinefeed::host {

/// Control points are rounded once, from double to offsets from the exact end of the previous segment. This closes gaps
/// up to CurveFile::largest_gap_mm, and gaps do not add up. A segment within 1 nm of its start is omitted.
template <Scalar S>
class BezierSource final : public CurveSource<S> {
public:
    /// @pre file.method is bezier; it outlives the source
    /// @param axes  axes of the machine, at least file.axes; the additional ones stay at 0
    /// @param repeat_seam  for SmoothedCurve: a closed file's last segment is also delivered before the first, and its
    ///                     first after the last
    BezierSource(const CurveFile& file, int axes, bool repeat_seam = false) noexcept;
    Pull next(CurveSegment<S>& out) noexcept override;
    /// Whether the seam is repeated: it was requested, and the ends of the file meet.
    [[nodiscard]] bool repeats_seam() const noexcept { return repeats_; }

private:
    [[nodiscard]] bool negligible(std::size_t segment) const noexcept;
    /// Writes a segment that begins at here_; false if it is omitted.
    bool deliver(std::size_t segment, CurveSegment<S>& out) noexcept;
    void go_to_start(std::size_t segment) noexcept;

    const CurveFile* file_;
    PerAxis<Position> here_{}; // the end of the previous segment
    std::size_t next_ = 0;
    int axes_;
    bool repeats_ = false;
    bool before_seam_ = false; // the last segment comes next, before the first
    bool after_seam_ = false;  // the first segment comes next, after the last
};

} // namespace splinefeed::host
