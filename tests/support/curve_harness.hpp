// SPDX-License-Identifier: MIT
//
// Feeds paths to the streaming curves, and reads what they emit exactly.
#pragma once

#include "splinefeed/s1_curve/waypoint_curve.hpp"
#include "support/catch.hpp"
#include "support/curve_oracle.hpp"

#include <concepts>
#include <limits>
#include <vector>

namespace splinefeed_test {

using splinefeed::Corner;
using splinefeed::CurveSegment;
using splinefeed::Fixed;
using splinefeed::Pull;
using splinefeed::Role;
using splinefeed::Scalar;
using splinefeed::Waypoint;

/// Half an ulp of a number of size 1; in Fixed of any number, in its unit.
template <Scalar S>
constexpr Real unit_roundoff() {
    if constexpr (std::same_as<S, Fixed>) {
        return 0x1p-33L;
    } else {
        return static_cast<Real>(std::numeric_limits<S>::epsilon()) / 2.0L;
    }
}

/// Error of a result of `size` mm computed in chord units with a few roundings of weights and products: a weight in
/// [0, 1] is wrong by at most u in every scalar, a Fixed product by 2^-33 chord units more.
template <Scalar S>
Real rounding(Real size_mm) {
    return unit_roundoff<S>() * size_mm + (std::same_as<S, Fixed> ? 0x1p-45L : 0.0L);
}

/// One waypoint with everything that is pushed with it.
template <Scalar S>
struct Feed {
    Waypoint<S> point;
    Role role = Role::path;
};

template <Scalar S>
std::vector<Feed<S>> feeds_of(const Path& path) {
    std::vector<Feed<S>> feeds;
    for (const auto& point : path.points) {
        feeds.push_back({{point, S{}, Corner::automatic}, Role::path});
    }
    return feeds;
}

/// A closed curve: 16 points of lead-in, the points, the first once more, 16 points of lead-out.
template <Scalar S>
std::vector<Feed<S>> open_feeds(const std::vector<Waypoint<S>>& points) {
    std::vector<Feed<S>> feeds;
    for (const auto& point : points) {
        feeds.push_back({point, Role::path});
    }
    return feeds;
}

template <Scalar S>
std::vector<Feed<S>> closed_feeds(const std::vector<Waypoint<S>>& points) {
    std::vector<Feed<S>> feeds;
    const int n = static_cast<int>(points.size());
    for (int i = -16; i <= n + 16; ++i) {
        const int wrapped = ((i % n) + n) % n;
        const Role role = i < 0 ? Role::lead_in : i <= n ? Role::path : Role::lead_out;
        feeds.push_back({points[static_cast<unsigned>(wrapped)], role});
    }
    return feeds;
}

template <Scalar S>
std::vector<Waypoint<S>> waypoints_of(const Path& path) {
    std::vector<Waypoint<S>> out;
    for (const auto& point : path.points) {
        out.push_back({point, S{}, Corner::automatic});
    }
    return out;
}

/// All segments that can be had now.
template <Scalar S, class Curve>
void drain(Curve& curve, std::vector<CurveSegment<S>>& out) {
    CurveSegment<S> segment;
    while (curve.next(segment) == Pull::item) {
        out.push_back(segment);
    }
}

/// eager: what can be had is taken after each push. lazy: taken one by one, only where there is no room.
enum class Pace : std::uint8_t { eager, lazy };

/// The whole curve.
template <Scalar S, class Curve>
std::vector<CurveSegment<S>> run_curve(Curve& curve, const std::vector<Feed<S>>& feeds, Pace pace = Pace::eager) {
    std::vector<CurveSegment<S>> out;
    for (const Feed<S>& feed : feeds) {
        while (!curve.has_room()) {
            CurveSegment<S> segment;
            if (curve.next(segment) == Pull::item) {
                out.push_back(segment);
            } else {
                REQUIRE(curve.has_room()); // it passed over lead-in
            }
        }
        REQUIRE(curve.push(feed.point, feed.role).ok());
        if (pace == Pace::eager) {
            drain<S>(curve, out);
        }
    }
    REQUIRE(curve.finish().ok());
    drain<S>(curve, out);
    CurveSegment<S> none;
    REQUIRE(curve.next(none) == Pull::finished);
    return out;
}

/// Bezier point i in mm from the segment's origin, exact.
template <Scalar S>
Vec bezier(const CurveSegment<S>& segment, int i) {
    Vec out{};
    for (const unsigned k : splinefeed::indices(segment.axes)) {
        out[k] = std::ldexp(exact(segment.control[k][static_cast<unsigned>(i)]), segment.unit_log2);
    }
    return out;
}

/// The origin of a segment from another's, exact.
template <Scalar S>
Vec origin_from(const CurveSegment<S>& segment, const PerAxis<Position>& from) {
    Vec out{};
    for (const unsigned k : splinefeed::indices(segment.axes)) {
        out[k] = std::ldexp(static_cast<Real>(segment.origin[k].raw - from[k].raw), -40);
    }
    return out;
}

/// Whether two segments are the same bits, wherever they are.
template <Scalar S>
bool same_shape(const CurveSegment<S>& a, const CurveSegment<S>& b) {
    bool same =
        a.axes == b.axes && a.degree == b.degree && a.unit_log2 == b.unit_log2 && a.stop_at_end == b.stop_at_end;
    for (unsigned k = 0; same && k < static_cast<unsigned>(a.axes); ++k) {
        for (unsigned i = 0; i <= static_cast<unsigned>(a.degree); ++i) {
            same = same && a.control[k][i] == b.control[k][i];
        }
    }
    return same;
}

template <Scalar S>
bool same_segment(const CurveSegment<S>& a, const CurveSegment<S>& b) {
    bool same = same_shape(a, b) && a.waypoint == b.waypoint && a.feed_mm_s == b.feed_mm_s;
    for (unsigned k = 0; same && k < static_cast<unsigned>(a.axes); ++k) {
        same = a.origin[k] == b.origin[k] && a.end[k] == b.end[k];
    }
    return same;
}

template <Scalar S>
bool same_curve(const std::vector<CurveSegment<S>>& a, const std::vector<CurveSegment<S>>& b) {
    bool same = a.size() == b.size();
    for (std::size_t i = 0; same && i < a.size(); ++i) {
        same = same_segment(a[i], b[i]);
    }
    return same;
}

/// How two neighbouring segments meet; errors relative to nothing, in mm and 1/mm.
struct Joint {
    Real gap = 0.0L;            ///< position
    Real direction = 0.0L;      ///< difference of the unit tangents
    Real curvature_jump = 0.0L; ///< length of the difference of the curvature vectors
    Real curvature = 0.0L;      ///< the larger of the two
    Real least_leg = 0.0L;      ///< the shorter of the Bezier legs at the joint
};

template <Scalar S>
Joint joint_of(const CurveSegment<S>& a, const CurveSegment<S>& b) {
    const Vec shift = origin_from(b, a.origin);
    const Vec leg_in = bezier(a, 3) - bezier(a, 2);
    const Vec leg_out = bezier(b, 1) - bezier(b, 0);
    Joint joint;
    joint.gap = distance_of(bezier(a, 3), shift + bezier(b, 0));
    joint.direction = distance_of((1.0L / size(leg_in)) * leg_in, (1.0L / size(leg_out)) * leg_out);
    const Vec k_in = curvature(bezier(a, 3), bezier(a, 2), bezier(a, 1));
    const Vec k_out = curvature(bezier(b, 0), bezier(b, 1), bezier(b, 2));
    joint.curvature_jump = distance_of(k_in, k_out);
    joint.curvature = std::max(size(k_in), size(k_out));
    joint.least_leg = std::min(size(leg_in), size(leg_out));
    return joint;
}

} // namespace splinefeed_test
