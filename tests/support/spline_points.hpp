// SPDX-License-Identifier: MIT
//
// Points for the whole-curve methods, and what they made, read exactly.
#pragma once

#include "splinefeed/splines/bezier_piece.hpp"
#include "support/curve_harness.hpp"

namespace splinefeed_test {

/// Coordinates within +-32; short: multiples of 2^-10, exact in every scalar and on the grid of Position.
template <Scalar S>
std::vector<splinefeed::Point<S>> random_points(RandomPath& random, int axes, int count, bool short_binary = true) {
    std::vector<splinefeed::Point<S>> points(static_cast<unsigned>(count));
    for (auto& point : points) {
        for (const unsigned k : splinefeed::indices(axes)) {
            const double x = short_binary ? (random.below(1 << 16) - (1 << 15)) * 0x1p-10 : random.between(-32.0, 32.0);
            point[k] = splinefeed::from_double<S>(x);
        }
    }
    return points;
}

template <Scalar S>
Vec exact_point(const splinefeed::Point<S>& point) {
    Vec out{};
    for (unsigned k = 0; k < 6; ++k) {
        out[k] = exact(point[k]);
    }
    return out;
}

template <Scalar S>
std::vector<Vec> exact_points(const std::vector<splinefeed::Point<S>>& points) {
    std::vector<Vec> out;
    for (const auto& point : points) {
        out.push_back(exact_point(point));
    }
    return out;
}

inline Real largest_coordinate(const std::vector<Vec>& points) {
    Real largest = 0.0L;
    for (const Vec& point : points) {
        for (const Real x : point) {
            largest = std::max(largest, std::fabs(x));
        }
    }
    return largest;
}

/// Waypoints at points of short binary fractions, no corners.
template <Scalar S>
std::vector<Waypoint<S>> waypoints_at(const std::vector<splinefeed::Point<S>>& points) {
    std::vector<Waypoint<S>> out;
    for (const auto& point : points) {
        Waypoint<S> waypoint;
        for (unsigned k = 0; k < 6; ++k) {
            waypoint.position[k] = splinefeed::position_from_mm(static_cast<double>(exact(point[k])));
        }
        waypoint.corner = Corner::forbidden;
        out.push_back(waypoint);
    }
    return out;
}

/// Streamed cubics against those of the whole-curve method, bit by bit.
inline void require_same_cubics(const std::vector<CurveSegment<double>>& segments,
                                const std::vector<splinefeed::BezierPiece<double>>& pieces, int axes) {
    REQUIRE(segments.size() == pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        for (int k = 0; k < axes; ++k) {
            for (int p = 0; p <= 3; ++p) {
                CAPTURE(i, k, p);
                REQUIRE(segments[i].control_mm(k, p) ==
                        pieces[i].control[static_cast<unsigned>(k)][static_cast<unsigned>(p)]);
            }
        }
    }
}

} // namespace splinefeed_test
