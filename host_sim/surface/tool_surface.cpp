// SPDX-License-Identifier: MIT
#include "host_sim/surface/raster.hpp"
#include "host_sim/surface/vector.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::host {

std::vector<double> creases(std::span<const double> knots, int degree) {
    const auto k = static_cast<std::size_t>(degree);
    std::vector<double> found;
    for (std::size_t i = k + 1; i + 2 * k < knots.size(); ++i) {
        if (knots[i] == knots[i + k - 1] && knots[i] > knots[k] && knots[i] < knots[knots.size() - k - 1] &&
            (found.empty() || found.back() < knots[i])) {
            found.push_back(knots[i]);
        }
    }
    return found;
}

ToolSurface::ToolSurface(const DescribedSurface& surface, const RasterOptions& options)
    : view_(surface.view()), options_(&options), along_u_(options.along == SurfaceDirection::u) {
    if (surface.axes != 3) {
        throw DescriptionError("the points have {} numbers; a tool path needs x, y and z", surface.axes);
    }
    if (options.ball_radius_mm > 0.0 &&
        !(creases(view_.knots_u, view_.degree_u).empty() && creases(view_.knots_v, view_.degree_v).empty())) {
        throw DescriptionError(
            "the surface has creases, at which a ball would jump; raise its degree to 2 at least, or "
            "leave out --ball-radius");
    }
    double up = 0.0;
    int normals = 0;
    constexpr int looks = 16;
    for (int i = 0; i <= looks; ++i) {
        for (int j = 0; j <= looks; ++j) {
            const auto at = [](int n, double first, double last) {
                return first + (last - first) * n / looks;
            };
            const auto found =
                normal_at(view_, at(i, view_.first_u(), view_.last_u()), at(j, view_.first_v(), view_.last_v()));
            up += found.has_value() ? found->direction[2] : 0.0;
            normals += found.has_value() ? 1 : 0;
        }
    }
    if (options.ball_radius_mm > 0.0 && std::fabs(up) < 1e-6 * normals) {
        throw DescriptionError("the surface stands upright: its normals look neither up nor down on the whole, so that "
                               "no side is the ball's; tilt it so that the side to be cut looks up, or leave out "
                               "--ball-radius");
    }
    side_ = up < 0.0 ? -1.0 : 1.0;
}

SurfaceJet<double> ToolSurface::jet(double along, double across) const noexcept {
    return along_u_ ? evaluate(view_, along, across) : evaluate(view_, across, along);
}

Contact ToolSurface::contact(double along, double across) const {
    const double u = along_u_ ? along : across;
    const double v = along_u_ ? across : along;
    const SurfaceJet<double> here = evaluate(view_, u, v);
    const auto found = normal_of(view_, here, !(u < view_.last_u()), !(v < view_.last_v()));
    if (!found.has_value()) {
        throw DescriptionError("the surface has no normal at u = {:.6g}, v = {:.6g}: a ball has no place "
                               "there; leave out --ball-radius, or move the points apart",
                               u, v);
    }
    return {here.position, along_u_ ? here.u : here.v, plus({}, side_, found->direction)};
}

Point<double> ToolSurface::normal(double along, double across) const {
    return contact(along, across).normal;
}

Point<double> ToolSurface::centre(double along, double across) const {
    if (!(options_->ball_radius_mm > 0.0)) {
        return jet(along, across).position;
    }
    const Contact here = contact(along, across);
    return plus(here.position, options_->ball_radius_mm, here.normal);
}

Point<double> ToolSurface::tool(double along, double across) const {
    Vector at = centre(along, across);
    if (options_->tip) {
        at[2] -= options_->ball_radius_mm;
    }
    return at;
}

double ToolSurface::highest_mm() const noexcept {
    const auto lower = [](const Vector& a, const Vector& b) {
        return a[2] < b[2];
    };
    const double top = (*std::ranges::max_element(view_.net, lower))[2];
    return options_->tip ? top : top + options_->ball_radius_mm;
}

// The principal curvatures are the eigenvalues of the second fundamental form (L M N) against the first (E F G).
std::optional<double> ToolSurface::hollow(double along, double across) const {
    const double at_u = along_u_ ? along : across;
    const double at_v = along_u_ ? across : along;
    const SurfaceJet<double> s = evaluate(view_, at_u, at_v);
    const auto found = normal_of(view_, s, !(at_u < view_.last_u()), !(at_v < view_.last_v()));
    if (!found.has_value() || found->limit) { // what is left of a derivative is rounding
        return std::nullopt;
    }
    const Vector n = plus({}, side_, found->direction);
    const double e = dot(s.u, s.u);
    const double f = dot(s.u, s.v);
    const double g = dot(s.v, s.v);
    const double area_sq = e * g - f * f;
    if (!(area_sq > 1e-18 * e * g) || !(e * g > 0.0)) {
        return std::nullopt;
    }
    const double l = dot(s.uu, n);
    const double m = dot(s.uv, n);
    const double k = dot(s.vv, n);
    const double mean = (e * k - 2.0 * f * m + g * l) / (2.0 * area_sq);
    const double product = (l * k - m * m) / area_sq;
    return mean + std::sqrt(std::max(0.0, mean * mean - product));
}

} // namespace splinefeed::host
