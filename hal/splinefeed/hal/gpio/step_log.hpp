// SPDX-License-Identifier: MIT
// StepLog: log of steps with their instants, written by the real-time thread, read to get axis positions at an instant.
#pragma once

#include "splinefeed/base/capacity.hpp"

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

namespace splinefeed::hal::gpio {

/// Lock-free: one writer, which never waits, and any number of readers, each with its own Reader.
class StepLog {
public:
    /// Holds the last 2^16 steps. Allocates here only.
    StepLog() : entry_(capacity) {}

    /// Adds a step; for the writer only. @pre instants do not decrease
    void add(std::uint64_t at_ns, unsigned axis, bool up) noexcept {
        const std::uint64_t head = head_.load(std::memory_order_relaxed);
        entry_[head % capacity].store(at_ns << 4U | std::uint64_t{axis} << 1U | (up ? 1U : 0U),
                                      std::memory_order_relaxed);
        head_.store(head + 1, std::memory_order_release);
    }

    /// Counts are relative to the start of the log.
    class Reader {
    public:
        explicit Reader(const StepLog& log) noexcept : log_(&log) {}

        /// Positions of all axes at that instant. Empty if the instant is before that of an earlier call, or if the log
        /// has overwritten steps that this reader had not read.
        [[nodiscard]] std::optional<PerAxis<std::int64_t>> counts_at(std::uint64_t instant_ns) noexcept {
            const std::uint64_t head = log_->head_.load(std::memory_order_acquire);
            for (; tail_ != head && !lost_; ++tail_) {
                const std::uint64_t entry = log_->entry_[tail_ % capacity].load(std::memory_order_relaxed);
                std::atomic_thread_fence(std::memory_order_acquire);
                lost_ =
                    log_->head_.load(std::memory_order_relaxed) - tail_ >= capacity; // the writer may be overwriting it
                if (after(entry, instant_ns) || lost_) {
                    break;
                }
                counts_[(entry >> 1U) & 7U] += (entry & 1U) != 0 ? 1 : -1;
                last_entry_ = entry;
                any_ = true;
            }
            return lost_ || (any_ && after(last_entry_, instant_ns)) ? std::nullopt : std::optional(counts_);
        }

    private:
        /// Whether an entry is later than the instant. Entries hold instants modulo 2^60 ns, 36 years.
        [[nodiscard]] static bool after(std::uint64_t entry, std::uint64_t instant_ns) noexcept {
            return static_cast<std::int64_t>((entry & ~std::uint64_t{15}) - (instant_ns << 4U)) > 0;
        }

        const StepLog* log_;
        std::uint64_t tail_ = 0;
        std::uint64_t last_entry_ = 0; // the last entry read
        PerAxis<std::int64_t> counts_{};
        bool any_ = false;
        bool lost_ = false;
    };

private:
    static constexpr std::uint64_t capacity = 1U << 16U;
    static_assert(max_axes <= 8);

    std::vector<std::atomic<std::uint64_t>> entry_;
    std::atomic<std::uint64_t> head_{0};
};

} // namespace splinefeed::hal::gpio
