// SPDX-License-Identifier: MIT
// Motions on a straight line through all axes, from rest to rest: how far the axes are from each other on it is how far
// the machine is from its path.
#pragma once

#include "splinefeed/s4_segment_stream/feed_segment.hpp"

#include <cmath>
#include <vector>

namespace splinefeed_test {

/// Axis k travels share[k] of the way.
inline constexpr std::array<double, 6> way_share{1.0, -0.5, 0.25, 0.75, -1.0, 0.5};

struct SmoothMotion {
    std::vector<splinefeed::FeedSegment> segments;
    double fastest_counts_s = 0.0; ///< of the first axis
};

/// Out and back `legs` times by `counts`, each leg of so many segments; at the end of each leg the machine rests.
inline SmoothMotion smooth_motion(double counts, int legs, int segments_a_leg, std::uint32_t segment_us) {
    using splinefeed::units_per_count;
    SmoothMotion motion;
    motion.fastest_counts_s = 1.5 * counts / (1e-6 * segment_us * segments_a_leg);
    const auto position = [&](int leg, int i, double share) {
        const double u = static_cast<double>(i) / segments_a_leg;
        const double s = u * u * (3.0 - 2.0 * u);
        return std::llround(share * counts * (leg % 2 == 0 ? s : 1.0 - s)) * units_per_count;
    };
    const auto velocity = [&](int leg, int i, double share) {
        const double u = static_cast<double>(i) / segments_a_leg;
        const double v = 6.0 * u * (1.0 - u) / segments_a_leg;
        return std::llround(share * counts * (leg % 2 == 0 ? v : -v)) * units_per_count;
    };
    for (int leg = 0; leg < legs; ++leg) {
        for (int i = 0; i < segments_a_leg; ++i) {
            splinefeed::FeedSegment out;
            out.index = motion.segments.size();
            out.duration_ticks = 8 * segment_us;
            for (std::size_t k = 0; k < way_share.size() && k < out.start.size(); ++k) {
                out.start[k] = position(leg, i, way_share[k]);
                out.end[k] = position(leg, i + 1, way_share[k]);
                out.start_velocity[k] = velocity(leg, i, way_share[k]);
                out.end_velocity[k] = velocity(leg, i + 1, way_share[k]);
            }
            motion.segments.push_back(out);
        }
    }
    return motion;
}

} // namespace splinefeed_test
