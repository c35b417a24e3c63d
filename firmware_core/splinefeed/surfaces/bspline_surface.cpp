// SPDX-License-Identifier: MIT
//
// Rows first: r_i = sum_j N_j(v) d_ij for the k_u + 1 rows of the span, with both derivatives by v; then the same sums
// over i. All sums are of differences to one point of the row (weighted_sum), so their error is relative to the piece.
#include "splinefeed/surfaces/bspline_surface.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"

namespace splinefeed {

namespace {

template <Scalar S>
S limited(S value, S low, S high) noexcept {
    return larger(low, smaller(value, high));
}

// Counts as zero compared with points that are 1 apart.
template <Scalar S>
constexpr S none() noexcept {
    return std::same_as<S, double> ? literal<S>(0x1p-40) : literal<S>(0x1p-18);
}

template <Scalar S>
S length(const Point<S>& vector) noexcept {
    return norm(vector, 3);
}

template <Scalar S>
Point<S> unit(const Point<S>& vector, S size) noexcept {
    Point<S> out{};
    for (unsigned k = 0; k < 3; ++k) {
        out[k] = vector[k] / size;
    }
    return out;
}

// The rounding of zero, compared with a coordinate of 1: a few tens of ulp; in Fixed the accuracy of a solved net.
template <Scalar S>
constexpr S rounding() noexcept {
    return std::same_as<S, double>  ? literal<S>(0x1p-46)
           : std::same_as<S, float> ? literal<S>(0x1p-19)
                                    : literal<S>(0x1p-26);
}

// Largest length at which a derivative counts as zero: compared with the extent of the (k_u + 1) (k_v + 1) points of
// the span, and with their coordinates, because points that should coincide, in a pole, differ by the rounding of
// these.
template <Scalar S>
S no_derivative(const BSplineSurface<S>& surface, const SurfaceJet<S>& jet) noexcept {
    const std::size_t first_u = jet.span_u - static_cast<std::size_t>(surface.degree_u);
    const std::size_t first_v = jet.span_v - static_cast<std::size_t>(surface.degree_v);
    Point<S> low = surface.net[first_u * surface.count_v() + first_v];
    Point<S> high = low;
    for (std::size_t i = first_u; i <= jet.span_u; ++i) {
        for (std::size_t j = first_v; j <= jet.span_v; ++j) {
            const Point<S>& point = surface.net[i * surface.count_v() + j];
            for (unsigned k = 0; k < 3; ++k) {
                low[k] = smaller(low[k], point[k]);
                high[k] = larger(high[k], point[k]);
            }
        }
    }
    S extent{};
    S place{};
    for (unsigned k = 0; k < 3; ++k) {
        extent = larger(extent, high[k] - low[k]);
        place = larger(place, larger(high[k], -low[k]));
    }
    return larger(extent * none<S>(), place * rounding<S>());
}

} // namespace

template <Scalar S>
Status check_surface(const BSplineSurface<S>& surface) noexcept {
    if (surface.axes < 1 || surface.axes > max_axes) {
        return Error::axes_out_of_range;
    }
    if (const Status status = check_knots(surface.knots_u, surface.degree_u); !status.ok()) {
        return status;
    }
    if (const Status status = check_knots(surface.knots_v, surface.degree_v); !status.ok()) {
        return status;
    }
    if (surface.net.size() != surface.count_u() * surface.count_v()) {
        return Error::storage_too_small;
    }
    return {};
}

template <Scalar S>
SurfaceJet<S> evaluate(const BSplineSurface<S>& surface, S u, S v) noexcept {
    const S at_u = limited(u, surface.first_u(), surface.last_u());
    const S at_v = limited(v, surface.first_v(), surface.last_v());
    const std::size_t span_u = find_span(surface.knots_u, surface.degree_u, at_u);
    const std::size_t span_v = find_span(surface.knots_v, surface.degree_v, at_v);
    const BasisDerivatives<S> basis_u = basis_derivatives(surface.knots_u, surface.degree_u, span_u, at_u);
    const BasisDerivatives<S> basis_v = basis_derivatives(surface.knots_v, surface.degree_v, span_v, at_v);
    const auto rows = static_cast<std::size_t>(surface.degree_u) + 1U;
    PerDegree<Point<S>> value{};
    PerDegree<Point<S>> first{};
    PerDegree<Point<S>> second{};
    for (std::size_t i = 0; i < rows; ++i) {
        const std::size_t at =
            (span_u + 1U - rows + i) * surface.count_v() + span_v - static_cast<std::size_t>(surface.degree_v);
        value[i] = weighted_sum(basis_v.value, surface.degree_v, false, surface.net, at, surface.axes);
        first[i] = weighted_sum(basis_v.first, surface.degree_v, true, surface.net, at, surface.axes);
        second[i] = weighted_sum(basis_v.second, surface.degree_v, true, surface.net, at, surface.axes);
    }
    const auto across = [&](const PerDegree<S>& weights, bool derivative, const PerDegree<Point<S>>& points) {
        return weighted_sum(weights, surface.degree_u, derivative, std::span<const Point<S>>(points.data(), rows), 0,
                            surface.axes);
    };
    SurfaceJet<S> jet;
    jet.span_u = span_u;
    jet.span_v = span_v;
    jet.length_u = surface.knots_u[span_u + 1U] - surface.knots_u[span_u];
    jet.length_v = surface.knots_v[span_v + 1U] - surface.knots_v[span_v];
    jet.position = across(basis_u.value, false, value);
    jet.u = across(basis_u.first, true, value);
    jet.v = across(basis_u.value, false, first);
    jet.uu = across(basis_u.second, true, value);
    jet.uv = across(basis_u.first, true, first);
    jet.vv = across(basis_u.value, false, second);
    return jet;
}

template <Scalar S>
Status iso_curve(const BSplineSurface<S>& surface, SurfaceDirection along, S at,
                 std::span<Point<S>> controls) noexcept {
    const bool along_u = along == SurfaceDirection::u;
    const std::size_t count = along_u ? surface.count_u() : surface.count_v();
    if (controls.size() < count) {
        return Error::storage_too_small;
    }
    const std::span<const S> knots = along_u ? surface.knots_v : surface.knots_u;
    const int degree = along_u ? surface.degree_v : surface.degree_u;
    const S t =
        along_u ? limited(at, surface.first_v(), surface.last_v()) : limited(at, surface.first_u(), surface.last_u());
    const std::size_t span = find_span(knots, degree, t);
    const PerDegree<S> weights = basis_functions(knots, degree, span, t);
    const std::size_t first = span - static_cast<std::size_t>(degree);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t from = along_u ? i * surface.count_v() + first : first * surface.count_v() + i;
        controls[i] = weighted_sum(weights, degree, false, surface.net, from, surface.axes,
                                   along_u ? std::size_t{1} : surface.count_v());
    }
    return {};
}

template <Scalar S>
Result<SurfaceNormal<S>> normal_of(const BSplineSurface<S>& surface, const SurfaceJet<S>& jet, bool at_end_u,
                                   bool at_end_v) noexcept {
    if (surface.axes < 3) {
        return Error::axes_out_of_range;
    }
    const S zero = no_derivative(surface, jet);
    SurfaceNormal<S> out;
    Point<S> along = jet.u;
    Point<S> across = jet.v;
    bool turned = false;
    const bool no_u = !(length(jet.u) > zero);
    const bool no_v = !(length(jet.v) > zero);
    if (no_u && no_v) {
        return Error::tangent_vanishes;
    }
    if (no_u) { // S_u grows by S_uv with v, away from the end of the domain
        along = jet.uv;
        turned = at_end_v;
    } else if (no_v) {
        across = jet.uv;
        turned = at_end_u;
    }
    out.limit = no_u || no_v;
    const S size_u = length(along);
    const S size_v = length(across);
    if (!(size_u > zero) || !(size_v > zero)) {
        return Error::tangent_vanishes;
    }
    // With unit vectors, so that nothing overflows; the length is the sine of the angle between them.
    const Point<S> a = unit(along, size_u);
    const Point<S> b = unit(across, size_v);
    const Point<S> product{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    const S sine = length(product);
    if (!(sine > none<S>())) {
        return Error::tangent_vanishes;
    }
    out.direction = unit(product, turned ? -sine : sine);
    return out;
}

template <Scalar S>
Result<SurfaceNormal<S>> normal_at(const BSplineSurface<S>& surface, S u, S v) noexcept {
    return normal_of(surface, evaluate(surface, u, v), !(u < surface.last_u()), !(v < surface.last_v()));
}

#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template Status check_surface(const BSplineSurface<S>&) noexcept;                                                  \
    template SurfaceJet<S> evaluate(const BSplineSurface<S>&, S, S) noexcept;                                          \
    template Status iso_curve(const BSplineSurface<S>&, SurfaceDirection, S, std::span<Point<S>>) noexcept;            \
    template Result<SurfaceNormal<S>> normal_of(const BSplineSurface<S>&, const SurfaceJet<S>&, bool, bool) noexcept;  \
    template Result<SurfaceNormal<S>> normal_at(const BSplineSurface<S>&, S, S) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
