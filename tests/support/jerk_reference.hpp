// SPDX-License-Identifier: MIT
//
// Cells along a curve whose direction is known everywhere, and what a motion asks of them, in long double.
#pragma once

#include "splinefeed/s3_feed_plan/jerk/jerk_cell.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed_test {

struct JerkLimits {
    double acceleration = 2000.0;
    double jerk = 50000.0;
    double cap_sq = 10000.0;
};

inline long double wide(double x) {
    return static_cast<long double>(x);
}

/// Two axes with the direction angle(s) = sum of two waves.
struct Wave {
    double size[2];
    double per_mm[2];
    [[nodiscard]] splinefeed::AxisEnd<double> end(unsigned axis, double s) const {
        double angle = 0.3;
        double bend = 0.0;
        double change = 0.0;
        for (int i = 0; i < 2; ++i) {
            const double w = per_mm[i];
            angle += size[i] * std::sin(w * s);
            bend += size[i] * w * std::cos(w * s);
            change -= size[i] * w * w * std::sin(w * s);
        }
        const double c = axis == 0 ? std::cos(angle) : std::sin(angle);
        const double d = axis == 0 ? -std::sin(angle) : std::cos(angle);
        splinefeed::AxisEnd<double> out;
        out.first = c;
        out.second = d * bend;
        out.third = d * change - c * bend * bend;
        return out;
    }
    [[nodiscard]] splinefeed::JerkCell<double> cell(double s, double length, const JerkLimits& limits) const {
        splinefeed::JerkCell<double> cell;
        cell.limits.axes = 2;
        cell.length_mm = length;
        cell.cap_sq = limits.cap_sq;
        for (unsigned k = 0; k < 2; ++k) {
            cell.end[0][k] = end(k, s);
            cell.end[1][k] = end(k, s + length);
            cell.limits.acceleration_mm_s2[k] = limits.acceleration;
            cell.limits.jerk_mm_s3[k] = limits.jerk;
            // q' is the cubic through its values and slopes at the ends.
            auto& [from, to] = cell.end;
            const double mid = 3.0 * (to[k].first - from[k].first) / length - (from[k].second + to[k].second);
            from[k].third = 2.0 * (mid - from[k].second) / length;
            to[k].third = 2.0 * (to[k].second - mid) / length;
        }
        return cell;
    }
};

/// The cell as a plan in R has it.
template <splinefeed::Floating R>
splinefeed::JerkCell<R> cell_in(const splinefeed::JerkCell<double>& cell) {
    splinefeed::JerkCell<R> out;
    out.length_mm = static_cast<R>(cell.length_mm);
    out.cap_sq = static_cast<R>(cell.cap_sq);
    out.limits.axes = cell.limits.axes;
    for (const unsigned k : splinefeed::indices(cell.limits.axes)) {
        out.limits.acceleration_mm_s2[k] = static_cast<R>(cell.limits.acceleration_mm_s2[k]);
        out.limits.jerk_mm_s3[k] = static_cast<R>(cell.limits.jerk_mm_s3[k]);
        for (unsigned e = 0; e < 2; ++e) {
            const splinefeed::AxisEnd<double>& at = cell.end[e][k];
            out.end[e][k] = {static_cast<R>(at.first), static_cast<R>(at.second), static_cast<R>(at.third),
                             static_cast<R>(at.second_spread), static_cast<R>(at.third_spread)};
        }
    }
    return out;
}

struct JerkUse {
    long double acceleration = 0; ///< of the limits
    long double jerk = 0;
    long double speed_sq = 0;
    long double least_sq = 0;
};

/// Largest use of the limits at many points of a cell that begins with b, slope and has the curvature u of b; dq/ds is
/// the cubic through the values and slopes at the ends.
inline JerkUse use_of(const splinefeed::JerkCell<double>& cell, long double b0, long double slope, long double u) {
    JerkUse use;
    use.least_sq = b0 / wide(cell.cap_sq);
    constexpr int points = 40;
    const long double l = wide(cell.length_mm);
    for (int i = 0; i <= points; ++i) {
        const long double x = static_cast<long double>(i) / points;
        const long double b = b0 + x * l * (slope + x * l * u / 2);
        const long double db = slope + x * l * u;
        use.speed_sq = std::max(use.speed_sq, b / wide(cell.cap_sq));
        use.least_sq = std::min(use.least_sq, b / wide(cell.cap_sq));
        for (const unsigned k : splinefeed::indices(cell.limits.axes)) {
            const auto& p = cell.end[0][k];
            const auto& q = cell.end[1][k];
            const long double d0 = wide(p.second) * l;
            const long double d1 = wide(q.second) * l;
            const long double c2 = 3.0L * (wide(q.first) - wide(p.first)) - 2 * d0 - d1;
            const long double c3 = 2.0L * (wide(p.first) - wide(q.first)) + d0 + d1;
            const long double first = wide(p.first) + x * (d0 + x * (c2 + x * c3));
            const long double second = (d0 + x * (2 * c2 + x * 3 * c3)) / l;
            const long double third = (2 * c2 + x * 6 * c3) / (l * l);
            const long double a = (std::abs(first * db / 2 + second * b) + wide(p.second_spread) * b) /
                                  wide(cell.limits.acceleration_mm_s2[k]);
            const long double j =
                std::sqrt(std::max(b, 0.0L)) *
                (std::abs(first * u / 2 + 3 * second * db / 2 + third * b) + wide(p.third_spread) * b);
            use.acceleration = std::max(use.acceleration, a);
            use.jerk = std::max(use.jerk, j / wide(cell.limits.jerk_mm_s3[k]));
        }
    }
    return use;
}

} // namespace splinefeed_test
