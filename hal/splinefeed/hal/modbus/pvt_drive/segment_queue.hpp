// SPDX-License-Identifier: MIT
// SegmentQueue: the segments that the drive holds, by their sequence numbers (docs/reference/pvt_map.md).
#pragma once

#include "splinefeed/hal/modbus/pvt/pvt_map.hpp"

#include <cstdint>
#include <span>

namespace splinefeed::hal::modbus {

/// Sequence numbers count modulo 2^32. A segment is begun when its motion is computed, and executed when it has been
/// made; until then it occupies its place.
class SegmentQueue {
public:
    using Segment = PvtSegment;
    using Refusal = PvtRefusal;

    /// What would be left if the segments from some number on were dropped.
    struct Left {
        std::uint32_t end = 0;   ///< the first one that is dropped
        std::uint64_t ticks = 0; ///< of those that are left, from the beginning of front()
        bool rests = false;      ///< one of them has the rest mark
    };

    /// `storage` must outlive it. @pre it is not empty
    SegmentQueue(std::span<Segment> storage, int axes) noexcept : segment_(storage), axes_(axes) {}

    /// Makes the queue empty; the next segment is `first`.
    void begin(std::uint32_t first) noexcept;
    /// Accepts the segments that are new, or none of them and returns the reason.
    [[nodiscard]] Refusal take(std::uint32_t first, std::span<const Segment> segments) noexcept;
    /// @param begun  whether front() is being executed: it is not dropped
    [[nodiscard]] Left left_before(std::uint32_t sequence, bool begun) const noexcept;
    void drop_from(const Left& left) noexcept;

    [[nodiscard]] bool empty() const noexcept { return next_ == front_; }
    /// The segment to compute. @pre not empty()
    [[nodiscard]] const Segment& front() const noexcept { return at(front_); }
    /// Ends front(). @pre not empty()
    void pass() noexcept;
    /// All before this number have been made. @pre it is from executed() to passed()
    void set_executed(std::uint32_t sequence) noexcept { executed_ = sequence; }

    [[nodiscard]] std::uint32_t next() const noexcept { return next_; }
    [[nodiscard]] std::uint32_t passed() const noexcept { return front_; }
    [[nodiscard]] std::uint32_t executed() const noexcept { return executed_; }
    [[nodiscard]] std::uint16_t capacity() const noexcept { return static_cast<std::uint16_t>(segment_.size()); }
    [[nodiscard]] std::uint16_t free() const noexcept {
        return static_cast<std::uint16_t>(segment_.size() - (next_ - executed_));
    }
    /// Duration of all segments from front() on.
    [[nodiscard]] std::uint64_t ticks() const noexcept { return ticks_; }
    [[nodiscard]] bool rests_ahead() const noexcept { return rests_ > 0; }

private:
    [[nodiscard]] const Segment& at(std::uint32_t sequence) const noexcept {
        return segment_[(sequence - origin_) % segment_.size()];
    }
    [[nodiscard]] bool is_executable(const Segment& segment) const noexcept;

    std::span<Segment> segment_;
    int axes_;
    std::uint32_t origin_ = 0; // the sequence number at place 0: moved on before numbers wrap
    std::uint32_t executed_ = 0;
    std::uint32_t front_ = 0;
    std::uint32_t next_ = 0;
    std::uint32_t rests_ = 0;
    std::uint64_t ticks_ = 0;
};

} // namespace splinefeed::hal::modbus
