// SPDX-License-Identifier: MIT
// MotionClock: the time of a motion against a host's: it runs, slows down to stand for all axes alike, and goes on.
#pragma once

#include <cstdint>

namespace splinefeed::hal {

/// The motion's time runs at full rate from `start` on. From a `stop` on its rate falls to 0, from a `resume` on it
/// rises to 1, both by 1 within twice the reserve. All axes that follow it stay on the path, however they are told.
/// Instants, times and the reserve are in one unit, which is the caller's: nanoseconds, microseconds.
class MotionClock {
public:
    static constexpr std::uint64_t never = UINT64_MAX;

    /// @param reserve  motion on which it comes to a stand, 1 to 10^9
    explicit MotionClock(std::uint64_t reserve) noexcept : reserve_(reserve) {}

    /// At the motion's beginning; the rate is 1 at once.
    void start(std::uint64_t at) noexcept;
    /// Its time slows down from that instant on, or from its start where that is later. @pre not stopping()
    void stop(std::uint64_t at) noexcept;
    /// It stands, and begins to move at that instant. @pre at_standstill(at)
    void resume(std::uint64_t at) noexcept;
    /// The whole motion comes that much later from now on.
    void delay(std::uint64_t by) noexcept;

    [[nodiscard]] bool stopping() const noexcept { return stopping_; }
    [[nodiscard]] bool at_standstill(std::uint64_t now) const noexcept { return stopping_ && now >= standstill_from(); }
    /// When it stands at the earliest. @pre stopping()
    [[nodiscard]] std::uint64_t standstill_from() const noexcept { return stop_ + fall(); }

    /// The motion's time at that instant; 0 before its start.
    [[nodiscard]] std::uint64_t time(std::uint64_t now) const noexcept;
    /// When the motion's time is that, which may be before its beginning; never: it stands before. What was before the
    /// last stop or resume is due at that.
    [[nodiscard]] std::uint64_t instant(std::int64_t time) const noexcept;

private:
    [[nodiscard]] std::uint64_t risen(std::uint64_t passed) const noexcept;
    [[nodiscard]] std::uint64_t fall() const noexcept;

    std::uint64_t reserve_;
    std::uint64_t base_ = 0;           // its time at start_
    std::uint64_t start_ = UINT64_MAX; // not yet
    std::uint64_t stop_ = 0;
    bool rises_ = false; // from rate 0 at start_
    bool stopping_ = false;
};

} // namespace splinefeed::hal
