// SPDX-License-Identifier: MIT
// SegmentRing: feed segments from the thread that plans to the one that moves; one writer, one reader, no lock.
#pragma once

#include "splinefeed/s4_segment_stream/feed_segment.hpp"

#include <atomic>
#include <vector>

namespace splinefeed::hal::gpio {

class SegmentRing {
public:
    /// Allocates here and never again.
    explicit SegmentRing(std::size_t capacity) : segment_(capacity) {}

    /// The writer's.
    [[nodiscard]] std::size_t room() const noexcept {
        return segment_.size() -
               static_cast<std::size_t>(head_.load(std::memory_order_relaxed) - tail_.load(std::memory_order_acquire));
    }
    /// The writer's. @pre room() > 0
    void push(const FeedSegment& segment) noexcept {
        const std::uint64_t head = head_.load(std::memory_order_relaxed);
        segment_[head % segment_.size()] = segment;
        head_.store(head + 1, std::memory_order_release);
    }
    /// The reader's. False: it is empty.
    [[nodiscard]] bool pop(FeedSegment& out) noexcept {
        const std::uint64_t tail = tail_.load(std::memory_order_relaxed);
        if (tail == head_.load(std::memory_order_acquire)) {
            return false;
        }
        out = segment_[tail % segment_.size()];
        tail_.store(tail + 1, std::memory_order_release);
        return true;
    }
    /// The reader's: the next one, which stays. @pre not empty
    [[nodiscard]] const FeedSegment& front() const noexcept {
        return segment_[tail_.load(std::memory_order_relaxed) % segment_.size()];
    }
    [[nodiscard]] bool empty() const noexcept {
        return tail_.load(std::memory_order_acquire) == head_.load(std::memory_order_acquire);
    }
    /// @pre neither thread is at it
    void clear() noexcept { tail_.store(head_.load()); }

private:
    std::vector<FeedSegment> segment_;
    std::atomic<std::uint64_t> head_{0};
    std::atomic<std::uint64_t> tail_{0};
};

} // namespace splinefeed::hal::gpio
