// SPDX-License-Identifier: MIT
// surface_interpolation: the tensor-product B-spline surface through a grid of points.
//
// Sakude, section 3: the grid is interpolated along v, row by row, C_il = sum_j d_ij N_j(v_l) for l = 0...n and each i.
// Then the control points found are interpolated along u. Not followed: the printed C_ij = sum_j d_ij N_j(u_j), in
// which j is a summation index and free at once, and the parameter is of the wrong direction. The pages on the
// parameters of surfaces are missing in the scan; those here are means of normalised chords. Class: C^(k-1) in u and v
// with simple inner knots.
#pragma once

#include "splinefeed/splines/bspline_interpolation.hpp"
#include "splinefeed/splines/spline_parameters.hpp"
#include "splinefeed/surfaces/bspline_surface.hpp"

namespace splinefeed {

/// Points in rows: points[i * columns + j], i along u.
template <Scalar S>
struct PointGrid {
    int axes = 3;
    std::size_t rows = 0;    ///< points along u
    std::size_t columns = 0; ///< points along v
    std::span<const Point<S>> points{};
};

/// The kind of surface that is wanted.
struct SurfaceKind {
    int degree_u = 3;
    int degree_v = 3;
    Parameterization parameters = Parameterization::chordal;
    KnotRule knots = KnotRule::average; ///< uniform or average

    /// Scalars of storage for the larger of the two systems of equations.
    [[nodiscard]] constexpr std::size_t entries(std::size_t rows, std::size_t columns) const noexcept {
        const std::size_t u = InterpolationKind{degree_u}.band(rows).entries();
        const std::size_t v = InterpolationKind{degree_v}.band(columns).entries();
        return u < v ? v : u;
    }
};

/// Working memory of an interpolation, which also receives its result. Sizes: parameters as the grid, knots grid +
/// degree + 1, net rows * columns, entries SurfaceKind::entries, row and row_parameters the larger of rows and columns.
template <Scalar S>
struct SurfaceStorage {
    std::span<S> parameters_u{};
    std::span<S> parameters_v{};
    std::span<S> knots_u{};
    std::span<S> knots_v{};
    std::span<Point<S>> net{};
    std::span<S> entries{};
    std::span<Point<S>> row{};
    std::span<S> row_parameters{};
};

/// Parameters of a grid in one direction: the parameters of every row of points in that direction are normalised; the
/// result is their mean times `domain_length`. A row in which two neighbours coincide (the pole of a dome) is ignored;
/// if all rows are like that, the error is coincident_points. Other errors: as for spline_parameters. Cost: linear.
template <Scalar S>
Status grid_parameters(const PointGrid<S>& grid, SurfaceDirection along, Parameterization how, S domain_length,
                       const SurfaceStorage<S>& storage, std::span<S> parameters) noexcept;

/// The surface through the grid, for the parameters and knots in the storage; fills its net. Errors: as for
/// BsplineInterpolation::prepare and solve. Cost: rows * columns * (k_u + k_v) per axis.
template <Scalar S>
Status interpolate_net(const PointGrid<S>& grid, const SurfaceKind& kind, const SurfaceStorage<S>& storage) noexcept;

/// The complete interpolation: parameters, knots and net, on the domain [0, length_u] x [0, length_v]. Errors:
/// too_few_points (fewer than degree + 1 in a direction: use a lower degree), storage_too_small, position_out_of_range
/// (a coordinate is not finite), and those above.
template <Scalar S>
[[nodiscard]] Result<BSplineSurface<S>> interpolate_surface(const PointGrid<S>& grid, const SurfaceKind& kind,
                                                            S length_u, S length_v,
                                                            const SurfaceStorage<S>& storage) noexcept;

} // namespace splinefeed
