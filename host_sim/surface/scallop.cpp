// SPDX-License-Identifier: MIT
#include "host_sim/surface/raster.hpp"
#include "host_sim/surface/span_places.hpp"
#include "host_sim/surface/vector.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::host {

namespace {

// How much a ball that sweeps along the line leaves standing on a place of the surface: from there along the normal to
// where the ray enters the swept cylinder. A ray that misses it is stopped a radius up at least: more than any
// --scallop.
double left_standing(const Contact& place, const Vector& centre, double radius) {
    Vector to_ball = plus(centre, -1.0, place.position);
    if (const double size_sq = dot(place.direction, place.direction); size_sq > 0.0) {
        to_ball = plus(to_ball, -dot(to_ball, place.direction) / size_sq, place.direction);
    }
    const double up = dot(to_ball, place.normal);
    const double inside_sq = radius * radius - (dot(to_ball, to_ball) - up * up);
    if (!(inside_sq > 0.0) || up + std::sqrt(inside_sq) < 0.0) {
        return std::max(up, radius);
    }
    return up - std::sqrt(inside_sq);
}

// Where two heights meet that were a0 and b0 and became a1 and b1. They grow as the squares of distances, so that their
// roots are straight.
double meeting(double a0, double b0, double a1, double b1) {
    const auto root = [](double height) {
        return std::sqrt(std::max(0.0, height));
    };
    const double apart = std::fabs(root(b0) - root(a0));
    const double crossed = std::fabs(root(a1) - root(b1));
    const double part = apart + crossed > 0.0 ? apart / (apart + crossed) : 0.0;
    const double at = root(a0) + part * (root(a1) - root(a0));
    return at * at;
}

// By how much the surface is missed between the lines at one place along them: what both balls leave standing, or where
// one cuts into it.
double ridge_at(const ToolSurface& surface, double along, const std::vector<double>& between) {
    const double radius = surface.options().ball_radius_mm;
    const Contact first = surface.contact(along, between.front());
    const Contact last = surface.contact(along, between.back());
    const Vector ball = plus(first.position, radius, first.normal);
    const Vector next_ball = plus(last.position, radius, last.normal);
    double most = 0.0;
    double before = 0.0;
    double next_before = 0.0;
    for (std::size_t i = 0; i < between.size(); ++i) {
        const Contact place = i == 0 ? first : i + 1 < between.size() ? surface.contact(along, between[i]) : last;
        const double here = left_standing(place, ball, radius);
        const double next_here = left_standing(place, next_ball, radius);
        most = std::max(most, std::fabs(std::min(here, next_here)));
        if (i > 0 && (before < next_before) != (here < next_here)) { // the top of the ridge
            most = std::max(most, meeting(before, next_before, here, next_here));
        }
        before = here;
        next_before = next_here;
    }
    return most;
}

} // namespace

double ToolSurface::scallop_mm(double across, double next_across, double enough) const {
    const std::vector<double> between = span_places(view_, this->across(), across, next_across, 4, 6);
    double most = 0.0;
    for (const double place : span_places(view_, along(), first_along(), last_along(), 4, 64)) {
        most = std::max(most, ridge_at(*this, place, between));
        if (most > enough) {
            break;
        }
    }
    return most;
}

} // namespace splinefeed::host
