// SPDX-License-Identifier: MIT
// SegmentRing: a queue of feed segments from the thread that plans to the thread that moves, or from a main loop to an
// interrupt.
#pragma once

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/base/ring_index.hpp"
#include "splinefeed/s4_segment_stream/feed_segment.hpp"

#include <atomic>
#include <cstddef>
#include <span>

namespace splinefeed {

/// For one writer and one reader; either may be an interrupt. It needs no lock, and no read-modify-write instruction,
/// which a Cortex-M0 does not have. The storage belongs to the caller and must outlive the ring. The ring holds one
/// segment less than the storage has places.
class SegmentRing {
public:
    /// @pre storage.size() > 1
    explicit SegmentRing(std::span<FeedSegment> storage) noexcept : segment_(storage) {
        SPLINEFEED_ASSERT(storage.size() > 1);
    }

    /// Largest number of segments that it holds.
    [[nodiscard]] std::size_t capacity() const noexcept { return segment_.size() - 1; }
    /// For the writer: how many more segments fit.
    [[nodiscard]] std::size_t room() const noexcept {
        const std::size_t tail = tail_.load(std::memory_order_acquire);
        const std::size_t head = head_.load(std::memory_order_relaxed);
        return capacity() - (head >= tail ? head - tail : head + segment_.size() - tail);
    }
    /// For the writer. @pre room() > 0
    void push(const FeedSegment& segment) noexcept {
        SPLINEFEED_ASSERT(room() > 0);
        const std::size_t head = head_.load(std::memory_order_relaxed);
        segment_[head] = segment;
        head_.store(ring_index(head + 1, segment_.size()), std::memory_order_release);
    }
    /// For the reader. false: the ring is empty, and `out` is unchanged.
    [[nodiscard]] bool pop(FeedSegment& out) noexcept {
        const std::size_t tail = tail_.load(std::memory_order_relaxed);
        if (tail == head_.load(std::memory_order_acquire)) {
            return false;
        }
        out = segment_[tail];
        tail_.store(ring_index(tail + 1, segment_.size()), std::memory_order_release);
        return true;
    }
    /// For the reader: the next segment, without removing it. @pre not empty
    [[nodiscard]] const FeedSegment& front() const noexcept {
        SPLINEFEED_ASSERT(!empty());
        return segment_[tail_.load(std::memory_order_relaxed)];
    }
    /// For both.
    [[nodiscard]] bool empty() const noexcept {
        return tail_.load(std::memory_order_acquire) == head_.load(std::memory_order_acquire);
    }
    /// @pre neither writer nor reader uses it now
    void clear() noexcept { tail_.store(head_.load()); }

private:
    std::span<FeedSegment> segment_;
    std::atomic<std::size_t> head_{0}; // where the writer writes next
    std::atomic<std::size_t> tail_{0}; // where the reader reads next
};

static_assert(std::atomic<std::size_t>::is_always_lock_free);

} // namespace splinefeed
