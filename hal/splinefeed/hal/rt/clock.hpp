// SPDX-License-Identifier: MIT
// Clock: monotonic time for ports, and the threads that wait for it. Tests replace both by virtual time.
#pragma once

#include "splinefeed/base/units.hpp"
#include <cstdint>
#include <functional>
#include <memory>

namespace splinefeed::hal {

/// A thread that Clock::start() started.
class ClockThread {
public:
    ClockThread() = default;
    ClockThread(const ClockThread&) = delete;
    ClockThread& operator=(const ClockThread&) = delete;
    /// Joins the thread.
    virtual ~ClockThread() = default;
    /// Blocks until the thread's work has ended. A second call does nothing.
    virtual void join() noexcept = 0;
};

/// All instants are on one monotonic time scale with an arbitrary origin. Thread-safe.
class Clock {
public:
    Clock() = default;
    Clock(const Clock&) = delete;
    Clock& operator=(const Clock&) = delete;
    virtual ~Clock() = default;

    [[nodiscard]] virtual std::uint64_t now_ns() const noexcept = 0;
    /// Blocks until that instant; returns at once if it has passed.
    virtual void sleep_until_ns(std::uint64_t instant_ns) noexcept = 0;
    /// Runs `work` in a new thread, which must wait by this clock only.
    [[nodiscard]] virtual std::unique_ptr<ClockThread> start(std::function<void()> work) = 0;

    [[nodiscard]] std::uint64_t now_us() const noexcept { return now_ns() / ns_per_us; }
    void sleep_until_us(std::uint64_t instant_us) noexcept { sleep_until_ns(instant_us * ns_per_us); }
    void sleep_us(std::uint64_t duration_us) noexcept { sleep_until_ns(now_ns() + duration_us * ns_per_us); }
};

/// The clock on CLOCK_MONOTONIC and the system's threads.
[[nodiscard]] Clock& system_clock() noexcept;

/// Processor time that the calling thread has used. [us]
[[nodiscard]] std::uint64_t thread_us() noexcept;

} // namespace splinefeed::hal
