// SPDX-License-Identifier: MIT
// Jet: position and two derivatives of a Bezier segment at a parameter, by de Casteljau's construction.
#pragma once

#include "splinefeed/s1_curve/curve_segment.hpp"

namespace splinefeed {

/// In the units and from the origin of the segment it was evaluated on; derivatives by u.
template <Scalar S>
struct Jet {
    PerAxis<S> position{};
    PerAxis<S> first{};
    PerAxis<S> second{};
};

/// Evaluates a segment at u in [0, 1]. Convex combinations only: in Fixed the position is within degree/2 ulp, and no
/// intermediate value leaves the control points' box. Cost: degree (degree + 1) / 2 products per axis.
template <Scalar S>
void evaluate(const CurveSegment<S>& segment, S u, Jet<S>& out) noexcept;

} // namespace splinefeed
