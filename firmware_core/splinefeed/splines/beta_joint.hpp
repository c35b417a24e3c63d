// SPDX-License-Identifier: MIT
// BetaJoint: the first control points of a Bezier polygon that continues another one with geometric continuity, with
// bias beta1 and tension beta2 (Barsky & DeRose). Also the inverse: the betas of the joint of two given pieces.
#pragma once

#include "splinefeed/splines/bezier_piece.hpp"

namespace splinefeed {

/// The shape parameters of a joint. With q the curve before it and r the curve after it, the conditions are r'(0) =
/// beta1 q'(1) and r''(0) = beta1^2 q''(1) + beta2 q'(1).
template <Scalar S>
struct Beta {
    S beta1 = from_integer<S>(1); ///< bias, greater than 0; in Fixed at most 8192
    S beta2{};                    ///< tension; in Fixed within +-2^29
};

/// The first points of the polygon after a joint.
template <Scalar S>
struct BetaJoint {
    Point<S> w0{};
    Point<S> w1{};
    Point<S> w2{};            ///< order 2 only
    bool gamma_known = false; ///< order 2, and gamma and the apex are finite
    S gamma{};                ///< Farin's and Boehm's ratio, (9a)
    Point<S> apex{};          ///< T of (9d): the intersection of the lines through both inner legs
};

/// Continues `before` with class G1 (order 1) or G2 (order 2; C1+G2 for beta1 = 1, C2 if also beta2 = 0) of the
/// curvature vector, in any number of dimensions. Barsky & DeRose (8b) from the last three points A, B, C:
///   W0 = C, W1 = C + beta1 (C - B), W2 = C + (2 beta1 + c)(C - B) + beta1^2 ((C - B) - (B - A)), c = beta2 / (d - 1),
/// which is beta1^2 A - (2 beta1^2 + 2 beta1 + c) B + ((1 + beta1)^2 + c) C, written with differences.
/// Two misprints are not followed. One is the unnumbered constraint r'' = beta1 q'' + beta2 q' (it must be beta1^2; the
/// joint would only be G1). The other is the factor d in the last term of (8a) (the joint would be G2 for another
/// beta2). (9a) to (9e) give gamma and the apex. W2 is not computed from them: at beta2 = -beta1 (d - 1)(1 + beta1)
/// they are infinite and W2 is not. If they are infinite or beyond the range of S, `gamma_known` is false. Errors:
/// beta1 <= 0, a degree below the order, NaN, B = C (tangent_vanishes), and a sum beyond the range of S: |sum| <= ((2
/// beta1 + 1)^2 + 2 |c|) max |coordinate|. Error of a coordinate: 12 roundings of that bound.
template <Scalar S>
[[nodiscard]] Result<BetaJoint<S>> beta_joint(const BezierPiece<S>& before, const Beta<S>& beta, int order) noexcept;

/// The bound of |sum| above, per unit of the largest |coordinate|: the factor by which a joint may enlarge a chain.
template <Scalar S>
[[nodiscard]] Result<S> beta_growth(const Beta<S>& beta, int degree, int order) noexcept;

/// The measured continuity of a joint.
template <Scalar S>
struct BetaMeasure {
    Beta<S> beta{};     ///< beta1 = |r'| / |q'|; beta2 from the part of r'' - beta1^2 q'' along q'
    S gap{};            ///< |r(0) - q(1)|
    S tangent_jump{};   ///< length of the difference of the unit tangents: 0 if the joint is G1
    S curvature_jump{}; ///< |part of r'' - beta1^2 q'' normal to q'| / |r'|^2: 0 if the joint is also G2
};

/// Measures the joint of two pieces of any degrees: Barsky & DeRose's constraints, solved for the betas, with beta1^2
/// at q''. Errors: a first derivative is zero (tangent_vanishes: betas and curvature are undefined), or a number is
/// beyond the range of S. Cost: three roots, a dozen divisions.
template <Scalar S>
[[nodiscard]] Result<BetaMeasure<S>> measure_joint(const BezierPiece<S>& before, const BezierPiece<S>& after) noexcept;

} // namespace splinefeed
