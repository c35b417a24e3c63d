// SPDX-License-Identifier: MIT
// in_double: a curve segment for those who look at it: with the same numbers, whatever the scalar of the plan is.
#pragma once

#include "splinefeed/s1_curve/curve_segment.hpp"

namespace splinefeed::host {

[[nodiscard]] inline const CurveSegment<double>& in_double(const CurveSegment<double>& segment) noexcept {
    return segment;
}

/// Exact: offsets of Fixed are below 2^16 units, and double holds their 32 fraction bits, too.
template <Scalar S>
[[nodiscard]] CurveSegment<double> in_double(const CurveSegment<S>& segment) noexcept {
    CurveSegment<double> out;
    out.axes = segment.axes;
    out.degree = segment.degree;
    out.unit_log2 = segment.unit_log2;
    out.origin = segment.origin;
    out.end = segment.end;
    for (const unsigned k : indices(segment.axes)) {
        for (unsigned i = 0; i <= static_cast<unsigned>(segment.degree); ++i) {
            out.control[k][i] = to_double(segment.control[k][i]);
        }
    }
    out.feed_mm_s = to_double(segment.feed_mm_s);
    out.max_feed_mm_s = to_double(segment.max_feed_mm_s);
    out.stop_at_end = segment.stop_at_end;
    out.waypoint = segment.waypoint;
    return out;
}

} // namespace splinefeed::host
