// SPDX-License-Identifier: MIT
// CurveSource: what the rest of the pipeline sees of a curve method: a source of Bezier segments in travel order.
// Virtual, because it is called once per segment (a cost far below the segment's own) and because a new method then
// touches its own files and one line of the host's option table.
#pragma once

#include "splinefeed/base/status.hpp"
#include "splinefeed/s1_curve/curve_segment.hpp"

namespace splinefeed {

template <Scalar S>
class CurveSource {
public:
    /// Writes the next segment. `starved`: none until more waypoints are pushed or the input is finished.
    virtual Pull next(CurveSegment<S>& out) noexcept = 0;

protected:
    CurveSource() = default;
    CurveSource(const CurveSource&) = default;
    CurveSource(CurveSource&&) = default;
    CurveSource& operator=(const CurveSource&) = default;
    CurveSource& operator=(CurveSource&&) = default;
    // Protected and not virtual: nobody deletes through the interface, and firmware stays free of operator delete.
    ~CurveSource() = default;
};

} // namespace splinefeed
