// SPDX-License-Identifier: MIT
// BezierSource: the segments of a curve file as a curve source, executed as they stand.
#pragma once

#include "curve_file.hpp"

#include "splinefeed/s1_curve/curve_source.hpp"

namespace splinefeed::host {

/// Control points are rounded once, from double to offsets from the exact end of the segment before: gaps up to
/// CurveFile::largest_gap_mm close there and do not add up. Segments within 1 nm of their start are left out.
template <Scalar S>
class BezierSource final : public CurveSource<S> {
public:
    /// @pre file.method is bezier; it outlives the source
    /// @param axes  of the machine, at least file.axes; those beyond stay at 0
    BezierSource(const CurveFile& file, int axes) noexcept;
    Pull next(CurveSegment<S>& out) noexcept override;

private:
    const CurveFile* file_;
    PerAxis<Position> here_{}; // the end of the segment before
    std::size_t next_ = 0;
    int axes_;
};

} // namespace splinefeed::host
