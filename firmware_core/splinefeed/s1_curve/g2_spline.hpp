// SPDX-License-Identifier: MIT
// G2Spline: streaming interpolation of waypoints by a cubic B-spline; the default curve.
#pragma once

#include "splinefeed/s1_curve/control_point_stream.hpp"

namespace splinefeed {

/// Class C2 in the knot parameter, hence G2, within a run; broken at corners. Interpolates (within 0.268^13 of the
/// local second difference for even spacing; 2e-8 mm measured on spacings of 1000:1). Look-ahead and cost:
/// ControlPointStream. Source: de Boor's interpolation conditions by blossoms; Schoenberg-Whitney holds, total
/// positivity makes elimination without pivoting stable.
template <Scalar S>
class G2Spline final : public ControlPointStream<S, PlainJoints<S>> {
public:
    explicit G2Spline(const CurveOptions<S>& options, const EndTangents<S>& tangents = {}) noexcept
        : ControlPointStream<S, PlainJoints<S>>(options, tangents, {}) {}
};

} // namespace splinefeed
