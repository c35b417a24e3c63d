// SPDX-License-Identifier: MIT
//
// A move from rest to rest is symmetrical. To reach a speed v it takes
//     2 sqrt(v / J) over v sqrt(v / J)               where v <= A^2 / J,
//     v / A + A / J over v (v / A + A / J) / 2       above,
// and without a jerk limit A / J is 0.
#include "host_sim/analysis/exact_stop_time.hpp"

#include "host_sim/analysis/path_strand.hpp"

#include "splinefeed/number/vector.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace splinefeed::host {

namespace {

constexpr double unlimited = 1e30;

double arc_length(const PathStrand& strand, int axes, double& least_radius) {
    const PerAxis<double> from = strand.at(0.0);
    const PerAxis<double> to = strand.at(1.0);
    double others_sq = 0.0;
    for (unsigned k = 3; k < static_cast<unsigned>(std::min(axes, max_axes)); ++k) { // a build may have three
        others_sq += (to[k] - from[k]) * (to[k] - from[k]);
    }
    least_radius = strand.arc()->least_radius(others_sq);
    return strand.arc()->length(others_sq);
}

double curve_length(const PathStrand& strand, int axes, double& least_radius) {
    if (strand.arc()) {
        return arc_length(strand, axes, least_radius);
    }
    constexpr int parts = 64;
    const auto between = [axes](const PerAxis<double>& a, const PerAxis<double>& b) {
        const PerAxis<double> way = difference(b, a, axes);
        return std::sqrt(dot(way, way, axes));
    };
    double length = 0.0;
    PerAxis<double> older = strand.at(0.0);
    PerAxis<double> old = older;
    for (int i = 1; i <= parts; ++i) {
        const PerAxis<double> here = strand.at(i / static_cast<double>(parts));
        const double a = between(older, old);
        const double b = between(old, here);
        const double c = between(older, here);
        length += b;
        const double area_sq = (a + b + c) * (a + b - c) * (a - b + c) * (b + c - a); // 16 squared areas
        if (i > 1 && area_sq > 0.0) {
            least_radius = std::fmin(least_radius, a * b * c / std::sqrt(area_sq));
        }
        older = old;
        old = here;
    }
    return length;
}

} // namespace

double rest_to_rest_s(double length, double speed, double acceleration, double jerk) noexcept {
    const double rise = jerk > 0.0 ? acceleration / jerk : 0.0;
    const double knee = acceleration * rise; // below this speed the acceleration is not reached
    const auto half_s = [&](double v) {
        return v > knee ? v / acceleration + rise : 2.0 * std::sqrt(v / jerk);
    };
    if (!(length > 0.0)) {
        return 0.0;
    }
    if (length >= speed * half_s(speed)) {
        return half_s(speed) + length / speed;
    }
    if (length >= 2.0 * knee * rise) {
        const double most = 0.5 * (std::sqrt(knee * knee + 4.0 * acceleration * length) - knee);
        return 2.0 * half_s(most);
    }
    return 4.0 * std::cbrt(0.5 * length / jerk);
}

double ExactStopTime::feed_of(const PathElement<double>& move, double feed) noexcept {
    for (const double stated : {move.feed_mm_s, move.max_feed_mm_s}) {
        feed = stated > 0.0 ? std::fmin(feed, stated) : feed;
    }
    return feed;
}

double ExactStopTime::straight_s(const PathElement<double>& move) const noexcept {
    const int axes = settings_->axes;
    const PerAxis<double> way = distances<double>(here_, move.to, 0, axes);
    const double linear_sq =
        sum_of(axes, [&](unsigned k) { return settings_->axis[k].rotary ? 0.0 : way[k] * way[k]; });
    const double length = std::sqrt(dot(way, way, axes));
    // Of rotary axes alone the feed is that of the move: the one of the machine is of the linear axes.
    double speed = linear_sq > 0.0 ? feed_of(move, settings_->max_feed_mm_s) * length / std::sqrt(linear_sq)
                                   : feed_of(move, unlimited);
    double acceleration = unlimited;
    double jerk = unlimited;
    for (const unsigned k : indices(settings_->axes)) {
        const AxisSettings& axis = settings_->axis[k];
        if (way[k] != 0.0) {
            const double share = std::fabs(way[k]) / length;
            speed = std::fmin(speed, axis.max_velocity_mm_s / share);
            acceleration = std::fmin(acceleration, axis.smaller_acceleration_mm_s2() / share);
            jerk = axis.max_jerk_mm_s3 > 0.0 ? std::fmin(jerk, axis.max_jerk_mm_s3 / share) : jerk;
        }
    }
    return rest_to_rest_s(length, speed, acceleration, jerk < unlimited ? jerk : 0.0);
}

double ExactStopTime::bent_s(const PathElement<double>& move) const noexcept {
    const AxisTotals totals = axis_totals(*settings_);
    double speed = feed_of(move, settings_->max_feed_mm_s);
    for (const unsigned k : indices(settings_->axes)) {
        speed = std::fmin(speed, settings_->axis[k].max_velocity_mm_s);
    }
    const double acceleration = totals.softest / std::numbers::sqrt2;
    double radius = unlimited;
    const double length = curve_length(PathStrand(here_, move, settings_->axes), settings_->axes, radius);
    return rest_to_rest_s(length, std::fmin(speed, std::sqrt(acceleration * radius)), acceleration, totals.smoothest);
}

void ExactStopTime::move(const PathElement<double>& move) noexcept {
    seconds_ += move.shape == MoveShape::line ? straight_s(move) : bent_s(move);
    here_ = move.to;
}

} // namespace splinefeed::host
