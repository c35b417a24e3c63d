// SPDX-License-Identifier: MIT
// G2Bezier: streaming interpolation of waypoints by cubic Bezier segments, with bias and tension at the joints.
#pragma once

#include "splinefeed/s1_curve/control_point_stream.hpp"

namespace splinefeed {

/// r'(0) = beta1 q'(1), r''(0) = beta1^2 q''(1) + beta2 q'(1) at every waypoint (Barsky & DeRose, who print beta1
/// instead of beta1^2 at q''). Class G2 within a run, whatever the look-ahead; corners break the curve. With the
/// default joints and chordal spans it is G2Spline. splines/g2_bezier.hpp solves for the same curve from all points at
/// once. The streamed curve differs by what lies beyond the look-ahead: by q^13 of the local second difference. For
/// even chords q = 2 / (D + sqrt(D^2 - 4 beta1^3)) with D = 2 beta1^2 + 2 beta1 + beta2 / 2. q is 0.268 at beta1 = 1,
/// less with tension and with beta1 > 1, 0.37 at beta1 = 0.8 and 0.7 at beta1 = 0.5. With beta1 far below 1 the curve
/// misses waypoints visibly.
/// @pre joints.check() is ok
template <Scalar S>
class G2Bezier final : public ControlPointStream<S, BetaJoints<S>> {
public:
    explicit G2Bezier(const CurveOptions<S>& options, const BetaJoints<S>& joints = {},
                      const EndTangents<S>& tangents = {}) noexcept
        : ControlPointStream<S, BetaJoints<S>>(options, tangents, joints) {}
};

} // namespace splinefeed
