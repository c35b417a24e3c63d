// SPDX-License-Identifier: MIT
// PvtRing: the segments that a drive holds, and the present place in them (docs/reference/pvt_map.md).
#pragma once

#include "splinefeed/hal/modbus/pvt_drive/segment_queue.hpp"

#include <vector>

namespace splinefeed::host {

inline constexpr double map_units_per_count = std::int64_t{1} << hal::modbus::PvtSegment::position_bits;

/// The queue is that of the firmware; the place in it is of our own. Positions at the ends of segments are the integers
/// of the map: nothing is summed.
class PvtRing {
public:
    /// A point of the motion, in counts and in seconds of the segments' own time.
    struct Jet {
        double position = 0.0;
        double velocity = 0.0;
        double acceleration = 0.0;
    };

    /// A part of the ring, beginning at the present place.
    struct Left {
        double way_s = 0.0;
        bool rests = false; ///< one of its segments ends at standstill
    };

    /// @pre 1 <= axes <= max_axes, capacity >= 1
    PvtRing(int axes, std::uint16_t capacity);
    PvtRing(const PvtRing&) = delete; // the queue refers to its storage
    PvtRing(PvtRing&&) = default;     // which stays where it is
    PvtRing& operator=(const PvtRing&) = delete;
    PvtRing& operator=(PvtRing&&) = default;
    ~PvtRing() = default;

    /// Makes the ring empty; the next segment is `first` and starts at this position, at standstill. [1/2^16 count]
    void begin(std::uint32_t first, const PerAxis<std::int64_t>& position) noexcept;
    /// Accepts the segments that are new, or none and returns the reason: docs/reference/pvt_map.md. Cost: a copy of
    /// each.
    [[nodiscard]] hal::modbus::PvtRefusal take(std::uint32_t first,
                                               std::span<const hal::modbus::PvtSegment> segments) noexcept {
        return queue_.take(first, segments);
    }
    /// What would be left if the segments from this one on were dropped; the segment that is being executed is never
    /// dropped.
    [[nodiscard]] Left left_before(std::uint32_t sequence) const noexcept;
    /// Drops them. Cost of both functions: the number of segments.
    void end_before(std::uint32_t sequence) noexcept { queue_.drop_from(queue_.left_before(sequence, begun())); }

    [[nodiscard]] bool empty() const noexcept { return queue_.empty(); }
    [[nodiscard]] std::uint32_t next() const noexcept { return queue_.next(); }
    [[nodiscard]] std::uint32_t executed() const noexcept { return queue_.executed(); }
    [[nodiscard]] std::uint16_t free() const noexcept { return queue_.free(); }
    [[nodiscard]] std::uint16_t capacity() const noexcept { return queue_.capacity(); }

    /// Time to the end of the last segment, at full rate.
    [[nodiscard]] double ahead_s() const noexcept;
    /// Time to the end of the segment that is being executed. @pre not empty()
    [[nodiscard]] double segment_ahead_s() const noexcept;
    /// Whether a remaining segment ends at standstill.
    [[nodiscard]] bool rests_ahead() const noexcept { return queue_.rests_ahead(); }

    /// The segment that is being executed. @pre not empty()
    [[nodiscard]] const hal::modbus::PvtSegment& current() const noexcept { return queue_.front(); }
    /// Advances within the segment. @pre not empty(); way_s is at most segment_ahead_s()
    void pass(double way_s) noexcept;
    /// Advances exactly to its end, and begins the next one. @pre not empty()
    void finish() noexcept;
    /// Start position of the current segment, or of the next one. [counts]
    [[nodiscard]] double start(int axis) const noexcept;
    /// The present point of the motion; at standstill if the ring is empty.
    [[nodiscard]] Jet at(int axis) const noexcept;

private:
    [[nodiscard]] bool begun() const noexcept { return passed_ticks_ > 0.0; }

    std::vector<hal::modbus::PvtSegment> storage_;
    hal::modbus::SegmentQueue queue_;
    double passed_ticks_ = 0.0;        // of the current segment
    hal::modbus::PvtSegment before_{}; // its end is the start of the current segment
};

} // namespace splinefeed::host
