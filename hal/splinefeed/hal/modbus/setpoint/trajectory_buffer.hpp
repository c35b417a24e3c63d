// SPDX-License-Identifier: MIT
// TrajectoryBuffer: feed segments on the time axis of a motion: where each axis is at an instant.
#pragma once

#include "splinefeed/hal/modbus/profile/field_codec.hpp"
#include "splinefeed/s4_segment_stream/feed_segment.hpp"

#include <vector>

namespace splinefeed::hal::modbus {

struct TrajectoryPoint {
    std::int64_t position_q16 = 0; ///< [1/65536 count], within 2^-17 count
    double velocity = 0.0;         ///< [counts/s]
};

/// When a frame arrives, of our clock, and where the motion is then and when the next one arrives, by its own time
/// [us].
struct MotionInstant {
    std::uint64_t arrival_us = 0;
    std::uint64_t motion_us = 0;
    std::uint64_t next_us = 0;
};

/// Times are microseconds since the motion began. Not for several threads at once.
class TrajectoryBuffer {
public:
    /// Room for so many segments, allocated here and never again.
    explicit TrajectoryBuffer(std::size_t capacity) : ring_(capacity) {}

    /// A motion begins anew, at 0.
    void clear() noexcept;
    /// False where it is full, and nothing was taken. @pre it starts where the one before ended
    bool push(const FeedSegment& segment) noexcept;
    /// Forgets segments that end before this time.
    void release(std::uint64_t before_us) noexcept;
    [[nodiscard]] std::size_t room() const noexcept { return ring_.size() - count_; }
    [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
    /// The end of the last segment [us], rounded up.
    [[nodiscard]] std::uint64_t end_us() const noexcept;
    /// The last segment ends with velocity 0 in every axis: a complete motion.
    [[nodiscard]] bool ends_at_rest(int axes) const noexcept;

    /// Before the first segment where that starts, and behind the last where that ends, at rest. @pre not empty
    /// Cost: linear in the segments held between.
    [[nodiscard]] TrajectoryPoint at(int axis, std::uint64_t time_us) const noexcept;

private:
    struct Placed {
        std::uint64_t begin_ticks = 0;
        FeedSegment segment;
    };
    [[nodiscard]] const Placed& placed(std::size_t i) const noexcept { return ring_[(first_ + i) % ring_.size()]; }

    std::vector<Placed> ring_;
    std::size_t first_ = 0;
    std::size_t count_ = 0;
    std::uint64_t end_ticks_ = 0;
};

/// How far the path may be from the straight line between two of its points that are `period_us` apart, at most, where
/// both lie near this segment: period^2 |acceleration| / 8. [counts]
[[nodiscard]] double line_deviation_counts(const FeedSegment& segment, int axis, std::uint32_t period_us) noexcept;

} // namespace splinefeed::hal::modbus
