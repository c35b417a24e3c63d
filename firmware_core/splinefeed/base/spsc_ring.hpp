// SPDX-License-Identifier: MIT
// SpscRing: a queue from one writer to one reader, which may be threads, or a main loop and an interrupt.
#pragma once

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/base/ring_index.hpp"

#include <atomic>
#include <cstddef>
#include <span>

namespace splinefeed {

/// For one writer and one reader; either may be an interrupt. It needs no lock, and no read-modify-write instruction,
/// which a Cortex-M0 does not have. The storage belongs to the caller and must outlive the ring. The ring holds one
/// item less than the storage has places.
///
/// Memory order. Each index has one writer: the writer's side stores `head_`, the reader's side `tail_`. push() writes
/// the item, then stores head_ with release; who loads that value of head_ with acquire (size(), empty()) sees the
/// item. drop() stores tail_ with release after the item was read. The writer loads it with acquire (room()) before it
/// writes that item again. So an item is never written while it is read. Each side may load its own index relaxed,
/// because nobody else stores it. An old value of the other's index is safe: the writer then sees less room than there
/// is, the reader fewer items. A precondition that was found true stays true, since only the own side can end it. On
/// one core, between a main loop and an interrupt, the same orders keep the compiler from moving the accesses; the
/// processor needs no barrier there.
template <class T>
class SpscRing {
public:
    /// @pre storage.size() > 1
    explicit constexpr SpscRing(std::span<T> storage) noexcept : item_(storage) {
        SPLINEFEED_ASSERT(storage.size() > 1);
    }

    /// Largest number of items that it holds.
    [[nodiscard]] std::size_t capacity() const noexcept { return item_.size() - 1; }
    /// How many items it holds. Exact for both: for the writer it can only become less, for the reader only more.
    [[nodiscard]] std::size_t size() const noexcept {
        const std::size_t tail = tail_.load(std::memory_order_acquire);
        const std::size_t head = head_.load(std::memory_order_acquire);
        return head >= tail ? head - tail : head + item_.size() - tail;
    }
    /// For the writer: how many more items fit.
    [[nodiscard]] std::size_t room() const noexcept { return capacity() - size(); }
    /// For the writer. @pre room() > 0
    void push(const T& item) noexcept {
        SPLINEFEED_ASSERT(room() > 0);
        const std::size_t head = head_.load(std::memory_order_relaxed);
        item_[head] = item;
        head_.store(ring_index(head + 1, item_.size()), std::memory_order_release);
    }
    /// For the reader. false: the ring is empty, and `out` is unchanged.
    [[nodiscard]] bool pop(T& out) noexcept {
        if (empty()) {
            return false;
        }
        out = front();
        drop();
        return true;
    }
    /// For the reader: the next item, without removing it. @pre not empty
    [[nodiscard]] const T& front() const noexcept {
        SPLINEFEED_ASSERT(!empty());
        return item_[tail_.load(std::memory_order_relaxed)];
    }
    /// For the reader: removes the next item. @pre not empty
    void drop() noexcept {
        SPLINEFEED_ASSERT(!empty());
        tail_.store(ring_index(tail_.load(std::memory_order_relaxed) + 1, item_.size()), std::memory_order_release);
    }
    /// For both.
    [[nodiscard]] bool empty() const noexcept {
        return tail_.load(std::memory_order_acquire) == head_.load(std::memory_order_acquire);
    }
    /// @pre neither writer nor reader uses it now
    void clear() noexcept { tail_.store(head_.load()); }

private:
    std::span<T> item_;
    std::atomic<std::size_t> head_{0}; // where the writer writes next
    std::atomic<std::size_t> tail_{0}; // where the reader reads next
};

// A Cortex-M0 lacks the read-modify-write that this asks for, too; its loads and stores are single instructions.
#ifndef __ARM_ARCH_6M__
static_assert(std::atomic<std::size_t>::is_always_lock_free);
#endif

} // namespace splinefeed
