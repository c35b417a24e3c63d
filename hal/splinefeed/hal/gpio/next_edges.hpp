// SPDX-License-Identifier: MIT
// NextEdges: feed segments in, the edges of the next instant out.
#pragma once

#include "splinefeed/hal/gpio/pin_changes.hpp"
#include "splinefeed/s4_segment_stream/segment_ring.hpp"
#include "splinefeed/s5_pulse_train/any_pulse_train.hpp"

#include <atomic>
#include <vector>

namespace splinefeed::hal::gpio {

/// One thread pushes segments, another one gathers edges. Allocates in its constructor only.
class NextEdges {
public:
    NextEdges(int axes, const StepTiming& timing);
    /// Another motion, which may begin at any position. @pre no thread uses it now
    void reset() noexcept;

    /// Returns false, and takes nothing, where the queue is full.
    [[nodiscard]] bool push(const FeedSegment& segment) noexcept;
    [[nodiscard]] std::size_t room() const noexcept { return ring_.room(); }
    /// Segments whose edges are known.
    [[nodiscard]] std::uint64_t taken() const noexcept { return taken_.load(std::memory_order_relaxed); }

    /// The segment whose edges became known last: the motion is in it, or right before it.
    [[nodiscard]] const FeedSegment& current() const noexcept { return current_; }
    /// Collects all edges of the next instant, so that the lines change then without computation.
    /// @param complete  no segment comes behind those that were pushed before this was known
    /// Returns whether there are any; true again until made().
    [[nodiscard]] bool gather(PinChanges& lines, bool complete) noexcept;
    void made() noexcept { gathered_ = false; }
    [[nodiscard]] bool gathered() const noexcept { return gathered_; }
    /// Motion time of the gathered edges. [ticks]
    [[nodiscard]] std::int64_t tick() const noexcept { return tick_; }
    /// Whether the gathered edges step the axis.
    [[nodiscard]] bool steps(unsigned axis) const noexcept { return stepped_[axis]; }
    /// All edges of the motion were gathered.
    [[nodiscard]] bool exhausted() const noexcept { return finished_ && !have_ && !gathered_; }

private:
    [[nodiscard]] bool next(bool complete) noexcept;

    int axes_;
    StepTiming timing_;
    AnyPulseTrain train_;
    std::vector<FeedSegment> segments_; // storage of the ring
    SegmentRing ring_;
    std::atomic<std::uint64_t> taken_{0};
    FeedSegment current_;
    Edge edge_; // the next edge, if have_
    std::int64_t tick_ = 0;
    PerAxis<bool> stepped_{};
    bool have_ = false;
    bool gathered_ = false;
    bool finished_ = false; // the train's
};

} // namespace splinefeed::hal::gpio
