// SPDX-License-Identifier: MIT
// joint_report: how smoothly the pieces of a curve meet, measured on the pieces.
#pragma once

#include "host_sim/curve/methods/description.hpp"

namespace splinefeed::host {

/// Point, derivatives by the local parameter and curvature of a piece at u in [0, 1].
struct CurveSample {
    PerAxis<double> point{};
    PerAxis<double> first{};
    PerAxis<double> second{};
    PerAxis<double> curvature{}; ///< K: the part of `second` normal to `first`, over |first|^2
    double kappa = 0.0;          ///< with two axes signed, positive to the left; otherwise |K|
    bool regular = false;        ///< |first| is not zero; otherwise there is no curvature
};
[[nodiscard]] CurveSample sample_of(const BezierPiece<double>& piece, int axes, double u);

/// The tolerances with which two values count as equal.
struct Agreement {
    double relative = 1e-7;  ///< no method makes so small a jump on purpose
    double rounding = 1e-13; ///< rounding of a control point, relative to the largest of its piece, including the
                             ///< solution before it
};
/// The tolerances for curves computed in S.
template <Scalar S>
inline constexpr Agreement agreement_of{};
template <>
inline constexpr Agreement agreement_of<Fixed>{1e-6, 1e-10};
template <>
inline constexpr Agreement agreement_of<float>{1e-3, 2e-6};

/// An array with one object per joint: from, to, C0, C1, C2, regular, G1, G2, abs_kappa (only the modulus of curvature
/// is compared), length_ratio_d1, the jumps, beta1 and beta2 of joints with G1 (Barsky & DeRose), and class: C2, C1+G2,
/// G2, C1+|k|, G1+|k|, C1, G1, C0, with +singular if a first derivative is zero. C1 and C2 are by the curve's parameter
/// if it has intervals, otherwise by that of the pieces.
[[nodiscard]] nlohmann::ordered_json joint_report(const DescribedCurve& curve, const Agreement& agreement = {});

/// An array with one object for u = 0, 1/4, 1/2, 3/4, 1: u, p, d1, d2, kappa, K; null where undefined.
[[nodiscard]] nlohmann::ordered_json sample_report(const BezierPiece<double>& piece, int axes);

} // namespace splinefeed::host
