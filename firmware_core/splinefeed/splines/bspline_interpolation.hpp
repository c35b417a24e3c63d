// SPDX-License-Identifier: MIT
// BsplineInterpolation: the B-spline curve of degree 1 to 9 through given points, open or closed.
//
// Sakude, "Interpolação de curvas e superfícies por splines de grau arbitrário", sections 2 and 3 (system (4)).
// Not followed: "n = m + k control points" (n + 1 = m + k); "k the order" (k is the degree).
// The curve is of class C^(k-m) in t at a knot of multiplicity m: C^(k-1) with the rules of knot_vector.hpp.
#pragma once

#include "splinefeed/splines/banded_system.hpp"
#include "splinefeed/splines/knot_vector.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace splinefeed {

/// What shape of curve is asked for.
struct InterpolationKind {
    int degree = 3; ///< k, 1 to max_degree
    bool closed = false;
    bool end_derivatives = false; ///< the derivatives by t at both ends are given; open curves, degree >= 2

    /// Number of control points of a curve through `points` points.
    [[nodiscard]] constexpr std::size_t controls(std::size_t points) const noexcept {
        return closed ? points : open_control_count(points, end_derivatives);
    }
    /// Number of knots.
    [[nodiscard]] constexpr std::size_t knots(std::size_t points) const noexcept {
        return closed ? closed_knot_count(points, degree)
                      : open_knot_count(open_control_count(points, end_derivatives), degree);
    }
    /// Shape of its system: entries() scalars and interchanges() bytes of storage.
    [[nodiscard]] constexpr BandShape band(std::size_t points) const noexcept {
        return {controls(points), static_cast<std::size_t>(degree), closed,
                closed ? Elimination::pivoting : Elimination::in_order};
    }
};

/// Derivatives by the parameter t (not unit tangents): they scale with the domain.
template <Scalar S>
struct EndDerivatives {
    Point<S> start{};
    Point<S> end{};
};

/// The factored system of an interpolation: prepared once for parameters and knots, solved for as many right-hand sides
/// as share them (all rows of a surface). Open curves: totally positive and banded, eliminated without pivoting. Closed
/// curves: cyclic, with pivoting. Cost: prepare points * k^2, solve points * k per axis.
///
/// Error of the control points: condition * 4 (k + 1) u * largest coordinate, u = 2^-53, 2^-24, in Fixed 2^-46, and
/// there 4 (k + 1) ulp * condition more from rounding values; condition is that of the system
/// (docs/explanation/numbers.md).
template <Scalar S>
class BsplineInterpolation {
public:
    /// Builds and factors. Checked in this order:
    /// degree_out_of_range; too_few_points (open: fewer than k + 1 control points, lower the degree; closed: fewer than
    /// 3); storage_too_small; knots_invalid, a wrong number of them included; parameters_invalid (not strictly
    /// increasing, or outside the domain); even_degree_closed (even degree, even number of points, knots at the points:
    /// always singular); schoenberg_whitney (the condition below fails); system_singular.
    Status prepare(const InterpolationKind& kind, std::span<const S> parameters, std::span<const S> knots,
                   std::span<S> entries, std::span<std::uint8_t> interchanges) noexcept;

    /// Schoenberg-Whitney, the exact condition for an open system to be regular: knots[i] < t_i < knots[i+k+1] for all
    /// i (equality at the clamped ends only). The slack is the smallest of these distances, the two ends left out, 0 if
    /// there are none. With end derivatives t_0 and t_n count twice. Closed curves: for one cyclic numbering of the
    /// control points, the best; necessary there, sufficient only together with the pivots.
    [[nodiscard]] S slack() const noexcept { return slack_; }

    /// Index in the array of control points at which the value of point i is put before solve().
    [[nodiscard]] std::size_t slot(std::size_t point) const noexcept;

    /// Value to be put at index 1 (at_end: at the last but one) for a derivative there.
    [[nodiscard]] Point<S> derivative_value(const Point<S>& end_point, const Point<S>& derivative, int axes,
                                            bool at_end) const noexcept;

    /// Values in, control points out, at values[first + i * stride]. Errors: result_out_of_range. @pre prepared
    Status solve(std::span<Point<S>> values, int axes, std::size_t first = 0, std::size_t stride = 1) const noexcept {
        return system_.solve(values, axes, first, stride);
    }

    /// Control points of the curve through points. @param ends where the kind has end derivatives
    /// Errors: storage_too_small, result_out_of_range. @pre prepared, as many points as parameters
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
