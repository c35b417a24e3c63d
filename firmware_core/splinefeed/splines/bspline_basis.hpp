// SPDX-License-Identifier: MIT
// B-spline basis: the k + 1 functions of degree k that are nonzero at a parameter, and curves made of them.
//
// Spans are half-open [knots[i], knots[i+1]); the last non-empty span is closed. (Sakude prints closed spans; the sum
// of the basis functions would then be 2 at every simple inner knot.) The quotients of the recurrence never have the
// form 0/0: the span that contains the parameter is part of every denominator. Knots are numbered from 0, and basis
// function i starts at knots[i]. The sum of Sakude's (1) over u_{-k}... needs N_{i-k} instead of the printed N_i.
#pragma once

#include "splinefeed/splines/bezier_piece.hpp"
#include "splinefeed/splines/weight.hpp"

#include <cstddef>
#include <span>

namespace splinefeed {

/// Index i of the span that contains t: knots[i] <= t < knots[i+1], degree <= i. At or after the end of the domain it
/// is the last non-empty span, before its start the first. Cost: a binary search.
template <Scalar S>
[[nodiscard]] std::size_t find_span(std::span<const S> knots, int degree, S t) noexcept;

/// Basis functions span - degree ... span at t, as weights (weight.hpp): they are not negative and their sum is
/// weight_one, exactly in Fixed. Sakude's recurrence. In Fixed the error of each is at most degree * 2 ulp (2^-46),
/// plus the effect of the resolution of the knots on the spans. @pre knots[span] <= t <= knots[span+1]
template <Scalar S>
[[nodiscard]] PerDegree<S> basis_functions(std::span<const S> knots, int degree, std::size_t span, S t) noexcept;

/// Basis functions with their derivatives by the LOCAL parameter u = (t - knots[span]) / (knots[span+1] - knots[span]),
/// as weights: they stay below 4 k^2, whatever the unit of t. For derivatives by t divide by the length of the span, or
/// by its square. Entry j belongs to basis function span - degree + j.
template <Scalar S>
struct BasisDerivatives {
    PerDegree<S> value{};
    PerDegree<S> first{};
    PerDegree<S> second{}; ///< zero in degree 1
};

/// Values and two derivatives. @pre as for basis_functions
template <Scalar S>
[[nodiscard]] BasisDerivatives<S> basis_derivatives(std::span<const S> knots, int degree, std::size_t span,
                                                    S t) noexcept;

/// A point of a curve, with the derivatives by the local parameter of its span.
template <Scalar S>
struct CurveJet {
    std::size_t span = 0;
    S span_length{}; ///< knots[span+1] - knots[span]
    Point<S> position{};
    Point<S> first{};  ///< by the local parameter: span_length * dP/dt
    Point<S> second{}; ///< by the local parameter: span_length^2 * d2P/dt2
};

/// Sum of weights times points: entry j is the weight of points[(first + j * stride) modulo points.size()]. It is
/// computed from differences to one of the points, so the error is relative to the size of the piece and not to its
/// position. The weights sum to weight_one (a point) or to 0 (a derivative).
template <Scalar S>
[[nodiscard]] Point<S> weighted_sum(const PerDegree<S>& weights, int degree, bool derivative,
                                    std::span<const Point<S>> points, std::size_t first, int axes,
                                    std::size_t stride = 1) noexcept;

/// The curve at t. Control points repeat modulo their number (closed curves: N control points, N + 2k + 1 knots). Class
/// C^(k-m) in t at a knot of multiplicity m. @pre check_knots(knots, degree).ok(), t in the domain
template <Scalar S>
[[nodiscard]] CurveJet<S> bspline_curve(std::span<const S> knots, int degree, std::span<const Point<S>> controls,
                                        int axes, S t) noexcept;

} // namespace splinefeed
