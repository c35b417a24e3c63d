// SPDX-License-Identifier: MIT
// CurveWatch: whoever looks at a curve before it is planned.
#pragma once

#include "splinefeed/s1_curve/curve_segment.hpp"

namespace splinefeed::host {

class PathFeeder;

class CurveWatch {
public:
    /// The next segment in the order of travel. If it throws, the segment is not passed on, and the curve ends.
    /// @param row  of its waypoint, element or move in the input
    virtual void segment(const CurveSegment<double>& segment, std::uint32_t row, const PathFeeder& feeder) = 0;

protected:
    CurveWatch() = default;
    CurveWatch(const CurveWatch&) = default;
    CurveWatch& operator=(const CurveWatch&) = default;
    ~CurveWatch() = default;
};

} // namespace splinefeed::host
