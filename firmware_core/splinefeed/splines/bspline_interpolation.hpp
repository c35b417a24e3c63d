// SPDX-License-Identifier: MIT
// BsplineInterpolation: the B-spline curve of degree 1 to 9 through given points, open or closed.
//
// Sakude, "Interpolação de curvas e superfícies por splines de grau arbitrário", sections 2 and 3 (system (4)). Two
// misprints are not followed: "n = m + k control points" (n + 1 = m + k) and "k the order" (k is the degree). The curve
// is of class C^(k-m) in t at a knot of multiplicity m: C^(k-1) with the rules of knot_vector.hpp.
#pragma once

#include "splinefeed/splines/banded_system.hpp"
#include "splinefeed/splines/knot_vector.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace splinefeed {

/// The kind of curve that is wanted.
struct InterpolationKind {
    int degree = 3; ///< k, 1 to max_degree
    bool closed = false;
    bool end_derivatives = false; ///< the derivatives by t at both ends are given; only for open curves with degree >=
                                  ///< 2

    /// Number of control points of a curve through `points` points.
    [[nodiscard]] constexpr std::size_t controls(std::size_t points) const noexcept {
        return closed ? points : open_control_count(points, end_derivatives);
    }
    /// Number of knots.
    [[nodiscard]] constexpr std::size_t knots(std::size_t points) const noexcept {
        return closed ? closed_knot_count(points, degree)
                      : open_knot_count(open_control_count(points, end_derivatives), degree);
    }
    /// Shape of its system: it needs entries() scalars and interchanges() bytes of storage.
    [[nodiscard]] constexpr BandShape band(std::size_t points) const noexcept {
        return {controls(points), static_cast<std::size_t>(degree), closed,
                closed ? Elimination::pivoting : Elimination::in_order};
    }
};

/// Derivatives by the parameter t (not unit tangents): they change with the length of the domain.
template <Scalar S>
struct EndDerivatives {
    Point<S> start{};
    Point<S> end{};
};

/// The factored system of an interpolation. It is prepared once for parameters and knots, and then solved for any
/// number of right-hand sides (all rows of a surface). Open curves: totally positive and banded, eliminated without
/// pivoting. Closed curves: cyclic, with pivoting. Cost: prepare points * k^2, solve points * k per axis.
///
/// Error of the control points: condition * 4 (k + 1) u * largest coordinate, with u = 2^-53 (double), 2^-24 (float),
/// 2^-46 (Fixed). In Fixed 4 (k + 1) ulp * condition more, from rounding of values. The condition is that of the system
/// (docs/explanation/numbers.md).
template <Scalar S>
class BsplineInterpolation {
public:
    /// Builds and factors the system. Errors, checked in this order: degree_out_of_range; too_few_points (open: fewer
    /// than k + 1 control points, use a lower degree; closed: fewer than 3); storage_too_small. Then knots_invalid,
    /// also for a wrong number of knots; parameters_invalid (not strictly increasing, or outside the domain). Then
    /// even_degree_closed (even degree, even number of points, knots at the points: always singular);
    /// schoenberg_whitney (the condition below fails); system_singular.
    Status prepare(const InterpolationKind& kind, std::span<const S> parameters, std::span<const S> knots,
                   std::span<S> entries, std::span<std::uint8_t> interchanges) noexcept;

    /// The slack of the Schoenberg-Whitney condition. An open system is regular if and only if knots[i] < t_i <
    /// knots[i+k+1] for all i (with equality only at the clamped ends). The slack is the smallest of these distances
    /// without the two ends, or 0 if there are none. With end derivatives t_0 and t_n count twice. Closed curves: the
    /// best slack over the cyclic numberings of the control points; there the condition is necessary, and sufficient
    /// only together with the pivots.
    [[nodiscard]] S slack() const noexcept { return slack_; }

    /// Index in the array of control points where the value of point i is stored before solve().
    [[nodiscard]] std::size_t slot(std::size_t point) const noexcept;

    /// Value to store at index 1 (at_end: at the last but one) for a derivative there.
    [[nodiscard]] Point<S> derivative_value(const Point<S>& end_point, const Point<S>& derivative, int axes,
                                            bool at_end) const noexcept;

    /// Values in, control points out, at values[first + i * stride]. Errors: result_out_of_range. @pre prepare()
    /// succeeded
    [[nodiscard]] Status solve(std::span<Point<S>> values, int axes, std::size_t first = 0,
                               std::size_t stride = 1) const noexcept {
        return system_.solve(values, axes, first, stride);
    }

    /// Control points of the curve through the points. @param ends  needed if the kind has end derivatives
    /// Errors: storage_too_small, result_out_of_range. @pre prepare() succeeded, as many points as parameters
    Status interpolate(std::span<const Point<S>> points, const EndDerivatives<S>* ends, int axes,
                       std::span<Point<S>> controls) const noexcept;

private:
    Status prepare_open(std::span<const S> parameters) noexcept;
    Status prepare_closed(std::span<const S> parameters) noexcept;

    InterpolationKind kind_{};
    std::size_t points_ = 0;
    std::size_t shift_ = 0; ///< closed: point i belongs to control point i + shift
    std::span<const S> knots_{};
    S slack_{};
    BandedSystem<S> system_{};
};

} // namespace splinefeed
