// SPDX-License-Identifier: MIT
// BSplineSurface: a tensor-product B-spline surface, S(u, v) = sum_i sum_j d_ij N_i(u) N_j(v), as a view of its data.
//
// Sakude, "Interpolação de curvas e superfícies por splines de grau arbitrário", section 3. Class C^(k-1) in each
// direction if knots are simple. Basis and spans as in splines/bspline_basis.hpp (half-open spans, 0/0 never occurs).
#pragma once

#include "splinefeed/splines/bspline_basis.hpp"
#include "splinefeed/splines/knot_vector.hpp"

namespace splinefeed {

/// The two parameters of a surface.
enum class SurfaceDirection : std::uint8_t { u, v };

/// A view: knots and net belong to the caller. net[i * count_v() + j], i along u.
template <Scalar S>
struct BSplineSurface {
    int axes = 3;
    int degree_u = 0;
    int degree_v = 0;
    std::span<const S> knots_u{};
    std::span<const S> knots_v{};
    std::span<const Point<S>> net{};

    [[nodiscard]] std::size_t count_u() const noexcept {
        return knots_u.size() - static_cast<std::size_t>(degree_u) - 1U;
    }
    [[nodiscard]] std::size_t count_v() const noexcept {
        return knots_v.size() - static_cast<std::size_t>(degree_v) - 1U;
    }
    [[nodiscard]] S first_u() const noexcept { return knots_u[static_cast<std::size_t>(degree_u)]; }
    [[nodiscard]] S last_u() const noexcept { return knots_u[count_u()]; }
    [[nodiscard]] S first_v() const noexcept { return knots_v[static_cast<std::size_t>(degree_v)]; }
    [[nodiscard]] S last_v() const noexcept { return knots_v[count_v()]; }
};

/// Checks the view. Errors: axes_out_of_range, degree_out_of_range, knots_invalid, storage_too_small (the net has not
/// count_u * count_v points).
template <Scalar S>
Status check_surface(const BSplineSurface<S>& surface) noexcept;

/// A point of the surface with the derivatives by the LOCAL parameters of its span, (u - first) / length in [0, 1].
/// They stay below 4 k^2 times the size of the net, whatever the unit of the parameters. For the derivatives by u and v
/// divide by the lengths: u / length_u, uv / (length_u length_v), uu / length_u^2.
template <Scalar S>
struct SurfaceJet {
    std::size_t span_u = 0;
    std::size_t span_v = 0;
    S length_u{};
    S length_v{};
    Point<S> position{};
    Point<S> u{};
    Point<S> v{};
    Point<S> uu{};
    Point<S> uv{};
    Point<S> vv{};
};

/// S and its first and second derivatives at (u, v), which are limited to the domain. No storage. Cost: 3 (k_u + 1)
/// sums over k_v + 1 points and six over k_u + 1. @pre check_surface(surface).ok()
template <Scalar S>
[[nodiscard]] SurfaceJet<S> evaluate(const BSplineSurface<S>& surface, S u, S v) noexcept;

/// Control points of the iso-parametric curve in the direction `along`, with the other parameter constant at `at`. They
/// are those of a B-spline curve with the surface's degree and knots of that direction, exactly on the surface. Errors:
/// storage_too_small. Cost: k + 1 products per control point.
template <Scalar S>
Status iso_curve(const BSplineSurface<S>& surface, SurfaceDirection along, S at, std::span<Point<S>> controls) noexcept;

/// The unit normal along S_u x S_v, of the first three axes.
template <Scalar S>
struct SurfaceNormal {
    Point<S> direction{};
    bool limit = false; ///< a first derivative is zero here; the direction is the limit from inside the domain
};

/// The normal at a point that was evaluated. If S_u = 0 (an edge that shrinks to a pole) it is the limit of S_uv x S_v,
/// because S_u grows by S_uv into the domain; the same for S_v. The sign is that of the side on which the domain lies.
/// A derivative counts as zero relative to the size of the net of its span and the rounding of its coordinates. Errors:
/// axes_out_of_range (fewer than three axes), tangent_vanishes (both derivatives are zero, or parallel: no normal).
/// @param at_end_u,at_end_v  the domain lies before u (v), not after it
template <Scalar S>
[[nodiscard]] Result<SurfaceNormal<S>> normal_of(const BSplineSurface<S>& surface, const SurfaceJet<S>& jet,
                                                 bool at_end_u, bool at_end_v) noexcept;

/// evaluate() and normal_of() in one call.
template <Scalar S>
[[nodiscard]] Result<SurfaceNormal<S>> normal_at(const BSplineSurface<S>& surface, S u, S v) noexcept;

} // namespace splinefeed
