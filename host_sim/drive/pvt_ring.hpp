// SPDX-License-Identifier: MIT
// PvtRing: the segments that a drive holds, and where on them it is (docs/reference/pvt_map.md).
#pragma once

#include "splinefeed/hal/modbus/pvt/pvt_map.hpp"

#include <vector>

namespace splinefeed::host {

/// Sequence numbers count modulo 2^32. Positions at the ends of segments are the map's integers, nothing is added up.
class PvtRing {
public:
    /// A point of the motion, in counts and seconds of the segments' own time.
    struct Jet {
        double position = 0.0;
        double velocity = 0.0;
        double acceleration = 0.0;
    };

    /// A part of the ring from where the motion is.
    struct Left {
        std::size_t segments = 0;
        double way_s = 0.0;
        bool rests = false; ///< a segment of it ends at rest
    };

    /// @pre 1 <= axes <= max_axes, capacity >= 1
    PvtRing(int axes, std::uint16_t capacity);

    /// Empty; the next segment is `first` and starts here, at rest. [1/2^16 count]
    void begin(std::uint32_t first, const PerAxis<std::int64_t>& position) noexcept;
    /// Takes those that are new, or none and says why: docs/reference/pvt_map.md. Cost: a copy of each.
    [[nodiscard]] hal::modbus::PvtRefusal take(std::uint32_t first,
                                               std::span<const hal::modbus::PvtSegment> segments) noexcept;
    /// What would be left if the segments from this one on were dropped, but never the one that is being executed.
    [[nodiscard]] Left left_before(std::uint32_t sequence) const noexcept;
    /// Drops them. Cost of either: their number.
    void end_before(std::uint32_t sequence) noexcept;

    [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
    [[nodiscard]] std::uint32_t next() const noexcept { return executed_ + static_cast<std::uint32_t>(size_); }
    [[nodiscard]] std::uint32_t executed() const noexcept { return executed_; }
    [[nodiscard]] std::uint16_t free() const noexcept { return static_cast<std::uint16_t>(ring_.size() - size_); }
    [[nodiscard]] std::uint16_t capacity() const noexcept { return static_cast<std::uint16_t>(ring_.size()); }

    /// To the end of the last segment, at full rate.
    [[nodiscard]] double ahead_s() const noexcept;
    /// To the end of the segment that is executed. @pre not empty()
    [[nodiscard]] double segment_ahead_s() const noexcept;
    /// Whether a segment that is left ends at rest.
    [[nodiscard]] bool rests_ahead() const noexcept { return rests_ > 0; }

    /// The segment that is executed. @pre not empty()
    [[nodiscard]] const hal::modbus::PvtSegment& current() const noexcept { return ring_[head_]; }
    /// Goes on within it. @pre not empty(); way_s is at most segment_ahead_s()
    void pass(double way_s) noexcept;
    /// Goes to its end exactly, and on to the next one. @pre not empty()
    void finish() noexcept;
    /// Where the current segment, or the next to come, starts. [counts]
    [[nodiscard]] double start(int axis) const noexcept;
    /// Where the motion is; at rest where the ring is empty.
    [[nodiscard]] Jet at(int axis) const noexcept;

private:
    std::vector<hal::modbus::PvtSegment> ring_;
    int axes_;
    std::size_t head_ = 0;
    std::size_t size_ = 0;
    std::size_t rests_ = 0;
    std::uint32_t executed_ = 0;
    std::uint64_t ticks_ = 0;          // of all segments in the ring
    double passed_ticks_ = 0.0;        // of the current one
    hal::modbus::PvtSegment before_{}; // its end is where the current one starts
};

} // namespace splinefeed::host
