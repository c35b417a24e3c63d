// SPDX-License-Identifier: MIT
// MotionClock: maps host time to the time of a motion. It can slow down to standstill and resume, for all axes
// together.
#pragma once

#include <cstdint>

namespace splinefeed::hal {

/// From start() on motion time runs at rate 1. After stop() the rate falls linearly to 0, after resume() it rises
/// linearly to 1; each takes twice the reserve. Axes that take their positions at this time stay on the path. The
/// caller chooses one unit for instants, times and the reserve, for example nanoseconds.
class MotionClock {
public:
    static constexpr std::uint64_t never = UINT64_MAX;

    /// @param reserve  motion time that passes between stop() and standstill, 1 to 10^9
    explicit MotionClock(std::uint64_t reserve) noexcept : reserve_(reserve) {}

    /// Starts a motion at time 0 and at once at rate 1.
    void start(std::uint64_t at) noexcept;
    /// Begins to slow down at that instant, or at the start if that is later. @pre not stopping()
    void stop(std::uint64_t at) noexcept { stop(at, reserve_); }
    /// The same with another reserve for this stop: from rate 1 it takes twice that one. 1 to 10^9
    void stop(std::uint64_t at, std::uint64_t reserve) noexcept;
    /// Begins to speed up from standstill at that instant. @pre at_standstill(at)
    void resume(std::uint64_t at) noexcept;
    /// Shifts the rest of the motion to later instants by that much.
    void delay(std::uint64_t by) noexcept;

    [[nodiscard]] bool stopping() const noexcept { return stopping_; }
    [[nodiscard]] bool at_standstill(std::uint64_t now) const noexcept { return stopping_ && now >= standstill_from(); }
    /// The instant of standstill. @pre stopping()
    [[nodiscard]] std::uint64_t standstill_from() const noexcept { return stop_ + fall(); }

    /// Motion time at that instant; 0 before the start.
    [[nodiscard]] std::uint64_t time(std::uint64_t now) const noexcept;
    /// The instant of a motion time, which may be negative; `never` if the clock stands before it. A time before the
    /// last stop() or resume() gives the instant of that call.
    [[nodiscard]] std::uint64_t instant(std::int64_t time) const noexcept;

private:
    [[nodiscard]] std::uint64_t risen(std::uint64_t passed) const noexcept;
    [[nodiscard]] std::uint64_t fall() const noexcept;

    std::uint64_t reserve_;
    std::uint64_t stop_reserve_ = reserve_;
    std::uint64_t base_ = 0;           // motion time at start_
    std::uint64_t start_ = UINT64_MAX; // not started
    std::uint64_t stop_ = 0;
    bool rises_ = false; // at start_ the rate was 0
    bool stopping_ = false;
};

} // namespace splinefeed::hal
