// SPDX-License-Identifier: MIT
// Knot vectors of B-splines of degree k, numbered from 0: basis function i has the support knots[i] to knots[i+k+1].
//
// Open curves are clamped: the end knots repeat k + 1 times (Sakude's "k multiple knots" is a misprint; the example
// there has 4 for degree 3). Closed curves of N points have N + 2k + 1 knots, continued periodically. Their domain is
// knots[k] to knots[k+N], and control points repeat modulo N (the closed example there must end in 8, not 9).
#pragma once

#include "splinefeed/base/status.hpp"
#include "splinefeed/number/scalar.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace splinefeed {

/// How the inner knots of an interpolating spline follow from the parameters t_0 ... t_n of the points.
enum class KnotRule : std::uint8_t {
    uniform,          ///< at equal distances
    average,          ///< mean of k CONSECUTIVE parameters: (t_j + ... + t_{j+k-1}) / k, j = 1 ... n-k
    average_tangents, ///< the same with two end derivatives: j = 0 ... n-k+1
    params,           ///< at the parameters of the points
    midpoints,        ///< half way between these parameters; for closed curves
};

/// Number of control points of an open interpolating curve.
[[nodiscard]] constexpr std::size_t open_control_count(std::size_t points, bool end_derivatives) noexcept {
    return points + (end_derivatives ? 2U : 0U);
}
/// Number of knots of an open curve: control points + degree + 1.
[[nodiscard]] constexpr std::size_t open_knot_count(std::size_t controls, int degree) noexcept {
    return controls + static_cast<std::size_t>(degree) + 1U;
}
/// Number of knots of a closed curve.
[[nodiscard]] constexpr std::size_t closed_knot_count(std::size_t points, int degree) noexcept {
    return points + 2U * static_cast<std::size_t>(degree) + 1U;
}

/// Writes clamped knots for an open curve through points at `parameters` (first 0, last the domain length) into the
/// first open_knot_count(open_control_count(...), degree) entries of `knots`. Source: Sakude, section 2. The mean is of
/// k consecutive parameters, not of "the k nearest" as printed there, which can make the system singular. Errors:
/// degree_out_of_range, too_few_points (fewer than degree + 1 control points), storage_too_small, parameters_invalid,
/// knot_rule_unsuited. Cost: k additions per knot.
template <Scalar S>
Status open_knots(KnotRule rule, std::span<const S> parameters, int degree, bool end_derivatives,
                  std::span<S> knots) noexcept;

/// Writes periodic knots for a closed curve through points at `parameters` (first 0, all below the period) into the
/// first closed_knot_count entries of `knots`: uniform period * j / N, average (t_j + ... + t_{j+k-1}) / k, params t_j,
/// midpoints (t_j + t_{j+1}) / 2; modulo the period, in order, with knots[k] the smallest. Errors: as for open_knots;
/// average_tangents gives knot_rule_unsuited; fewer than 3 points give too_few_points.
template <Scalar S>
Status closed_knots(KnotRule rule, std::span<const S> parameters, int degree, S period, std::span<S> knots) noexcept;

/// Checks that these are knots of a B-spline: finite, not decreasing, none more than degree + 1 times, at least 2
/// degree + 2 of them, and a domain of length > 0. Errors: degree_out_of_range, knots_invalid.
template <Scalar S>
Status check_knots(std::span<const S> knots, int degree) noexcept;

/// Up to this distance a knot of a closed curve and a parameter count as equal, or a knot and the same knot one period
/// later. It is the rounding of multiples and sums.
template <Scalar S>
[[nodiscard]] S closed_knot_tolerance(S period) noexcept {
    return scale2(period, std::same_as<S, double> ? -46 : std::same_as<S, float> ? -18 : -40);
}

/// Checks that the knots (closed_knot_count of them) continue periodically. Errors: as for check_knots.
template <Scalar S>
Status check_closed_knots(std::span<const S> knots, int degree) noexcept;

} // namespace splinefeed
