// SPDX-License-Identifier: MIT
// TrajectoryBuffer: feed segments of a motion on its time axis; gives the position of each axis at any time.
#pragma once

#include "splinefeed/hal/modbus/profile/field_codec.hpp"
#include "splinefeed/s4_segment_stream/feed_segment.hpp"

#include <vector>

namespace splinefeed::hal::modbus {

struct TrajectoryPoint {
    std::int64_t position_q16 = 0; ///< [1/65536 count], within 2^-17 count
    double velocity = 0.0;         ///< [counts/s]
};

/// Arrival of a frame on the host clock, and the motion times at its arrival and at that of the next frame. [us]
struct MotionInstant {
    std::uint64_t arrival_us = 0;
    std::uint64_t motion_us = 0;
    std::uint64_t next_us = 0;
};

/// Times are microseconds since the start of the motion. Not thread-safe.
class TrajectoryBuffer {
public:
    /// Allocates room for `capacity` segments; never allocates again, but in reset().
    explicit TrajectoryBuffer(std::size_t capacity) : ring_(capacity) {}

    /// Removes all segments, and makes room for `capacity` of them; the next motion starts at time 0. Allocates.
    void reset(std::size_t capacity);
    /// Appends a segment. Returns false if the buffer is full. @pre the segment starts at the end of the previous one
    bool push(const FeedSegment& segment) noexcept;
    /// Removes segments that end before this time, but never the last one.
    void release(std::uint64_t before_us) noexcept;
    [[nodiscard]] std::size_t room() const noexcept { return ring_.size() - count_; }
    [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
    /// End of the last segment, rounded up. [us]
    [[nodiscard]] std::uint64_t end_us() const noexcept;
    /// Whether the last segment ends with velocity 0 in every axis; true without segments.
    [[nodiscard]] bool ends_at_rest() const noexcept;

    /// State of an axis at a time. Before the first segment: its start, at rest; after the last one: its end, at rest.
    /// Cost: logarithmic in the segments. @pre not empty
    [[nodiscard]] TrajectoryPoint at(int axis, std::uint64_t time_us) const noexcept;

private:
    struct Placed {
        std::uint64_t begin_ticks = 0;
        FeedSegment segment;
    };
    [[nodiscard]] const Placed& at_ticks(std::uint64_t ticks) const noexcept;
    [[nodiscard]] const Placed& placed(std::size_t i) const noexcept { return ring_[(first_ + i) % ring_.size()]; }

    std::vector<Placed> ring_;
    std::size_t first_ = 0;
    std::size_t count_ = 0;
    std::uint64_t end_ticks_ = 0;
};

/// Largest distance of the path from the straight line between two of its points that are `period_us` apart, near this
/// segment: period^2 |acceleration| / 8. [counts]
[[nodiscard]] double line_deviation_counts(const FeedSegment& segment, int axis, std::uint32_t period_us) noexcept;

} // namespace splinefeed::hal::modbus
