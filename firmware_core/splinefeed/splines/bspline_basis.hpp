// SPDX-License-Identifier: MIT
// B-spline basis: the k + 1 functions of degree k that differ from zero at a parameter, and curves made of them.
//
// Spans are half-open [knots[i], knots[i+1]), the last non-empty one is closed. (Sakude prints closed spans, which
// would make the sum of the basis functions 2 at every simple inner knot.) Quotients of the recurrence never have the
// form 0/0: a span holds the parameter, so every denominator contains it. Knots are numbered from 0 and basis function
// i starts at knots[i]; the sum of Sakude's (1) over u_{-k}... needs N_{i-k} instead of the N_i printed.
#pragma once

#include "splinefeed/splines/bezier_piece.hpp"
#include "splinefeed/splines/weight.hpp"

#include <cstddef>
#include <span>

namespace splinefeed {

/// Index i of the span that holds t: knots[i] <= t < knots[i+1], degree <= i; at and beyond the end of the domain the
/// last non-empty span, before its start the first. Cost: a binary search.
template <Scalar S>
[[nodiscard]] std::size_t find_span(std::span<const S> knots, int degree, S t) noexcept;

/// Basis functions span - degree ... span at t, as weights (weight.hpp): they are not negative and their sum is
/// weight_one, exactly in Fixed. Sakude's recurrence. In Fixed each is good to degree * 2 ulp (2^-46) plus what the
/// resolution of the knots leaves of the spans. @pre knots[span] <= t <= knots[span+1]
template <Scalar S>
[[nodiscard]] PerDegree<S> basis_functions(std::span<const S> knots, int degree, std::size_t span, S t) noexcept;

/// Basis functions with their derivatives by the LOCAL parameter u = (t - knots[span]) / (knots[span+1] - knots[span]),
/// as weights: they stay below 4 k^2 whatever the unit of t. For derivatives by t divide by the span's length, and by
/// its square. Entry j belongs to basis function span - degree + j.
template <Scalar S>
struct BasisDerivatives {
    PerDegree<S> value{};
    PerDegree<S> first{};
    PerDegree<S> second{}; ///< zero in degree 1
};

/// Values and two derivatives. @pre as basis_functions
template <Scalar S>
[[nodiscard]] BasisDerivatives<S> basis_derivatives(std::span<const S> knots, int degree, std::size_t span,
                                                    S t) noexcept;

/// A point of a curve with the derivatives by the local parameter of its span.
template <Scalar S>
struct CurveJet {
    std::size_t span = 0;
    S span_length{}; ///< knots[span+1] - knots[span]
    Point<S> position{};
    Point<S> first{};  ///< by the local parameter: span_length * dP/dt
    Point<S> second{}; ///< by the local parameter: span_length^2 * d2P/dt2
};

/// Sum of weights times points: entry j weighs points[(first + j * stride) modulo points.size()]. Computed from
/// differences to one of them, so that the error is relative to the piece of the curve and not to its place. The
/// weights sum to weight_one (a point) or to 0 (a derivative).
template <Scalar S>
[[nodiscard]] Point<S> weighted_sum(const PerDegree<S>& weights, int degree, bool derivative,
                                    std::span<const Point<S>> points, std::size_t first, int axes,
                                    std::size_t stride = 1) noexcept;

/// The curve at t. Control points repeat modulo their number (closed curves: N control points, N + 2k + 1 knots).
/// Class C^(k-m) in t at a knot of multiplicity m. @pre check_knots(knots, degree).ok(), t in the domain
template <Scalar S>
[[nodiscard]] CurveJet<S> bspline_curve(std::span<const S> knots, int degree, std::span<const Point<S>> controls,
                                        int axes, S t) noexcept;

} // namespace splinefeed
