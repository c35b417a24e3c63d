// SPDX-License-Identifier: MIT
// Jet: position and first two derivatives of a Bezier segment at a parameter, by de Casteljau's construction.
#pragma once

#include "splinefeed/s1_curve/curve_segment.hpp"

namespace splinefeed {

/// In the units of the segment, from its origin; the derivatives are by u.
template <Scalar S>
struct Jet {
    PerAxis<S> position{};
    PerAxis<S> first{};
    PerAxis<S> second{};
};

/// Evaluates a segment at u in [0, 1]. It uses convex combinations only: in Fixed the error of the position is at most
/// degree/2 ulp, and no intermediate value leaves the box of the control points. Cost: degree (degree + 1) / 2 products
/// per axis.
template <Scalar S>
void evaluate(const CurveSegment<S>& segment, S u, Jet<S>& out) noexcept;

} // namespace splinefeed
