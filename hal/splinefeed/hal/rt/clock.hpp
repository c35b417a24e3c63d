// SPDX-License-Identifier: MIT
// Clock: the monotonic time by which ports wait, and the threads that wait by it. A test replaces both.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

namespace splinefeed::hal {

/// A thread that a clock started.
class ClockThread {
public:
    ClockThread() = default;
    ClockThread(const ClockThread&) = delete;
    ClockThread& operator=(const ClockThread&) = delete;
    /// Joins.
    virtual ~ClockThread() = default;
    /// Returns when the thread's work has ended; a second call does nothing.
    virtual void join() noexcept = 0;
};

/// All instants are of one monotonic clock with an arbitrary origin. Several threads may use a clock at once.
class Clock {
public:
    Clock() = default;
    Clock(const Clock&) = delete;
    Clock& operator=(const Clock&) = delete;
    virtual ~Clock() = default;

    [[nodiscard]] virtual std::uint64_t now_ns() const noexcept = 0;
    /// Returns at that instant, or at once where it has passed.
    virtual void sleep_until_ns(std::uint64_t instant_ns) noexcept = 0;
    /// Runs the work in a thread of its own, whose waits all go through this clock.
    [[nodiscard]] virtual std::unique_ptr<ClockThread> start(std::function<void()> work) = 0;

    [[nodiscard]] std::uint64_t now_us() const noexcept { return now_ns() / ns_per_us; }
    void sleep_until_us(std::uint64_t instant_us) noexcept { sleep_until_ns(instant_us * ns_per_us); }
    void sleep_us(std::uint64_t duration_us) noexcept { sleep_until_ns(now_ns() + duration_us * ns_per_us); }

private:
    static constexpr std::uint64_t ns_per_us = 1000;
};

/// CLOCK_MONOTONIC and the system's threads.
[[nodiscard]] Clock& system_clock() noexcept;

/// Processor time of the calling thread. [us]
[[nodiscard]] std::uint64_t thread_us() noexcept;

} // namespace splinefeed::hal
