// SPDX-License-Identifier: MIT
// CurveSource: the interface between a curve method and the rest of the pipeline: a source of Bezier segments in the
// order of travel. The call is virtual: it happens once per segment and costs far less than the segment itself. A new
// method touches only its own files and one line of the host's option table.
#pragma once

#include "splinefeed/base/status.hpp"
#include "splinefeed/s1_curve/curve_segment.hpp"

namespace splinefeed {

template <Scalar S>
class CurveSource {
public:
    /// Writes the next segment. `starved`: there is none until more waypoints are pushed or the input is finished.
    virtual Pull next(CurveSegment<S>& out) noexcept = 0;

protected:
    CurveSource() = default;
    CurveSource(const CurveSource&) = default;
    CurveSource(CurveSource&&) = default;
    CurveSource& operator=(const CurveSource&) = default;
    CurveSource& operator=(CurveSource&&) = default;
    // Protected and not virtual: nobody deletes through this interface, and firmware needs no operator delete.
    ~CurveSource() = default;
};

} // namespace splinefeed
