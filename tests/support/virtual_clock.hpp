// SPDX-License-Identifier: MIT
// VirtualClock: a clock whose time passes only where every thread of it sleeps: runs of several threads repeat exactly,
// and take no longer than they compute.
#pragma once

#include "splinefeed/hal/rt/clock.hpp"

#include <vector>

namespace splinefeed_test {

/// Threads are fibers of the thread that made the clock: exactly one runs, the one with the earliest wake-up, and of
/// several the one that has waited longest. A mutex that is held while its owner sleeps would block for ever.
class VirtualClock final : public splinefeed::hal::Clock {
public:
    explicit VirtualClock(std::uint64_t start_ns = 1'000'000'000'000);
    VirtualClock(const VirtualClock&) = delete;
    VirtualClock& operator=(const VirtualClock&) = delete;
    /// @pre all of its threads were joined
    ~VirtualClock() override;

    [[nodiscard]] std::uint64_t now_ns() const noexcept override { return now_ns_; }
    void sleep_until_ns(std::uint64_t instant_ns) noexcept override;
    [[nodiscard]] std::unique_ptr<splinefeed::hal::ClockThread> start(std::function<void()> work) override;

    struct Fiber;
    /// Returns when it has ended.
    void join(Fiber& fiber) noexcept;
    void forget(Fiber& fiber) noexcept;

private:
    friend struct Fiber;
    void pass_on() noexcept;
    static void enter(unsigned high, unsigned low) noexcept;

    std::vector<std::unique_ptr<Fiber>> fibers_; // the first one is the thread that made the clock
    Fiber* running_;
    Fiber* before_ = nullptr; // that ran before the running one
    std::uint64_t now_ns_;
    std::uint64_t turn_ = 0;
};

} // namespace splinefeed_test
