// SPDX-License-Identifier: MIT
//
// Reproducible chains of feed segments, made for steps: fast and slow, smooth as the stream's and with jumps of the
// acceleration, of equal and of changing duration, with one to three reversals in a segment, from any position.
#pragma once

#include "splinefeed/s4_segment_stream/feed_segment.hpp"

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace splinefeed_test {

using splinefeed::FeedSegment;
using splinefeed::units_per_count;

class RandomSegments {
public:
    explicit RandomSegments(std::uint64_t seed) : generator_(seed) {}

    double between(double low, double high) {
        return low + (high - low) * static_cast<double>(generator_() >> 11U) * 0x1p-53;
    }
    int below(int end) { return static_cast<int>(generator_() % static_cast<std::uint64_t>(end)); }
    double decades(double low, double high) { return low * std::pow(high / low, between(0.0, 1.0)); }

    /// As the segment stream makes them: a uniform cubic B-spline from rest to rest, velocities below `rate` counts/s.
    std::vector<FeedSegment> smooth(int axes, int count, std::uint32_t ticks, double rate) {
        std::vector<FeedSegment> segments(static_cast<std::size_t>(count));
        for (const unsigned k : splinefeed::indices(axes)) {
            const double most = rate * ticks / 8e6 * units_per_count / 6.0; // of a difference [6 units]
            const double change = most * decades(1e-3, 0.3);
            auto at = static_cast<std::int64_t>(between(-1e6, 1e6) * units_per_count / 6.0);
            at = below(3) == 0 ? at / (units_per_count / 12) * (units_per_count / 12) : at; // also halves
            std::int64_t c[4] = {at, at, at, at};
            double v = 0.0;
            double wish = 0.0;
            for (int i = 0; i < count; ++i) {
                if (below(8) == 0) {
                    wish = below(4) == 0 ? 0.0 : most * between(-1.0, 1.0);
                }
                wish = i > count - 6 ? 0.0 : wish;
                v += std::fmin(std::fmax(wish - v, -change), change);
                v = i > count - 4 ? 0.0 : v;
                c[0] = c[1], c[1] = c[2], c[2] = c[3];
                c[3] += static_cast<std::int64_t>(v);
                FeedSegment& s = segments[static_cast<std::size_t>(i)];
                s.index = static_cast<std::uint64_t>(i);
                s.duration_ticks = ticks;
                s.start[k] = c[0] + 4 * c[1] + c[2];
                s.end[k] = c[1] + 4 * c[2] + c[3];
                s.start_velocity[k] = 3 * (c[2] - c[0]);
                s.end_velocity[k] = 3 * (c[3] - c[1]);
            }
        }
        return segments;
    }

    /// Any cubics that fit together in position and velocity, none of it above `rate` counts/s.
    std::vector<FeedSegment> rough(int axes, int count, std::uint32_t least_ticks, std::uint32_t most_ticks,
                                   double rate) {
        std::vector<FeedSegment> segments(static_cast<std::size_t>(count));
        for (FeedSegment& s : segments) {
            s.duration_ticks = static_cast<std::uint32_t>(between(least_ticks, most_ticks));
        }
        for (const unsigned k : splinefeed::indices(axes)) {
            auto position = static_cast<std::int64_t>(between(-1e5, 1e5) * units_per_count);
            double velocity = 0.0; // [counts/s]
            for (FeedSegment& s : segments) {
                const double per_duration = s.duration_ticks / 8e6 * units_per_count;
                // The Bezier points of the velocity stay below the rate: (v0, 3 way - v0 - v1, v1).
                const double size = rate * decades(1e-4, 0.99);
                const double next = &s == &segments.back() ? 0.0 : below(4) == 0 ? 0.0 : size * between(-1.0, 1.0);
                const double middle = size * between(-1.0, 1.0);
                s.start[k] = position;
                s.start_velocity[k] = static_cast<std::int64_t>(velocity * per_duration);
                s.end_velocity[k] = static_cast<std::int64_t>(next * per_duration);
                position += static_cast<std::int64_t>((velocity + middle + next) * per_duration / 3.0);
                s.end[k] = position;
                velocity = next;
            }
        }
        return segments;
    }

private:
    std::mt19937_64 generator_;
};

} // namespace splinefeed_test
