// SPDX-License-Identifier: MIT
// The programs that are measured: generated, so that a benchmark needs no file.
#pragma once

#include "splinefeed/s1_curve/waypoint.hpp"

#include <cmath>
#include <vector>

namespace bench {

template <splinefeed::Scalar S>
splinefeed::Waypoint<S> waypoint(double x, double y, double z) {
    splinefeed::Waypoint<S> out;
    out.position[0] = splinefeed::position_from_mm(x);
    out.position[1] = splinefeed::position_from_mm(y);
    out.position[2] = splinefeed::position_from_mm(z);
    return out;
}

/// 40 lines 2.5 mm apart of 0.5 mm steps over z = 3 sin(x/5) cos(y/7), there and back: 8040 waypoints.
template <splinefeed::Scalar S>
std::vector<splinefeed::Waypoint<S>> raster() {
    std::vector<splinefeed::Waypoint<S>> out;
    for (int line = 0; line < 40; ++line) {
        const double y = 2.5 * line;
        for (int i = 0; i <= 200; ++i) {
            const double x = 0.5 * (line % 2 == 0 ? i : 200 - i);
            out.push_back(waypoint<S>(x, y, 3.0 * std::sin(x / 5.0) * std::cos(y / 7.0)));
        }
    }
    return out;
}

/// Point i of an endless helix of 20 mm radius with 5 um of noise, about 0.35 mm a point.
template <splinefeed::Scalar S>
splinefeed::Waypoint<S> helix(std::int64_t i) {
    const double angle = 0.0174 * static_cast<double>(i);
    // A cheap repeatable noise: the fraction of a large multiple.
    const auto noise = [i](double factor) {
        const double x = factor * static_cast<double>(i);
        return 0.01 * (x - std::floor(x) - 0.5);
    };
    return waypoint<S>(20.0 * std::cos(angle) + noise(0.754877666), 20.0 * std::sin(angle) + noise(0.569840291),
                       1e-4 * static_cast<double>(i) + noise(0.618033989));
}

} // namespace bench
