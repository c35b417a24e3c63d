// SPDX-License-Identifier: MIT
//
// Where an axis is at any instant, from its feed segments, in long double: an independent way to the steps.
#pragma once

#include "splinefeed/s4_segment_stream/feed_segment.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace splinefeed_test {

using splinefeed::FeedSegment;
using splinefeed::units_per_count;
using Real = long double;

class IdealMotion {
public:
    IdealMotion(const std::vector<FeedSegment>& segments, unsigned axis) : segments_(&segments), axis_(axis) {
        std::int64_t start = 0;
        for (const FeedSegment& segment : segments) {
            starts_.push_back(start);
            start += segment.duration_ticks;
        }
        end_ = start;
    }

    [[nodiscard]] std::int64_t end_tick() const { return end_; }
    [[nodiscard]] const std::vector<std::int64_t>& starts() const { return starts_; }

    /// Position less `units`, in counts. Before the start and after the end the axis stands.
    [[nodiscard]] Real beyond(std::int64_t units, Real tick) const {
        const auto after = std::upper_bound(starts_.begin(), starts_.end(), tick);
        const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - starts_.begin(), 1) - 1);
        const FeedSegment& s = (*segments_)[i];
        const Real u = std::clamp((tick - static_cast<Real>(starts_[i])) / s.duration_ticks, 0.0L, 1.0L);
        const auto way = static_cast<Real>(s.end[axis_] - s.start[axis_]);
        const auto v0 = static_cast<Real>(s.start_velocity[axis_]);
        const auto v1 = static_cast<Real>(s.end_velocity[axis_]);
        const Real w = 1.0L - u;
        // Bezier form: the sum of terms that do not cancel near either end.
        const Real travelled = u * w * w * v0 + u * u * (3.0L - 2.0L * u) * way - u * u * w * v1;
        return (static_cast<Real>(s.start[axis_] - units) + travelled) / static_cast<Real>(units_per_count);
    }

    /// How far an instant is from the one at which the axis passes `units` upwards or downwards [ticks]; 1e9 where it
    /// does not do so within `window`. A position within `blur` counts counts as reached.
    [[nodiscard]] Real distance(std::int64_t units, bool up, std::int64_t tick, Real window, Real blur) const {
        const Real sign = up ? 1.0L : -1.0L;
        Real low = static_cast<Real>(tick) - window;
        Real high = static_cast<Real>(tick) + window;
        const Real before = sign * beyond(units, low);
        const Real after = sign * beyond(units, high);
        if (before > blur || after < -blur) {
            return 1e9L;
        }
        const Real reached = sign * beyond(units, static_cast<Real>(tick));
        if (std::fabs(reached) <= blur) {
            return 0.0L;
        }
        const Real target =
            reached > 0.0L ? blur : -blur; // the crossing nearest to the instant, with the blur's benefit
        for (int i = 0; i < 80; ++i) {
            const Real middle = 0.5L * (low + high);
            (sign * beyond(units, middle) < target ? low : high) = middle;
        }
        return std::fabs(low - static_cast<Real>(tick));
    }

private:
    const std::vector<FeedSegment>* segments_;
    unsigned axis_;
    std::vector<std::int64_t> starts_;
    std::int64_t end_ = 0;
};

} // namespace splinefeed_test
