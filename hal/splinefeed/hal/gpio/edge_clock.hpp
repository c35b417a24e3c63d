// SPDX-License-Identifier: MIT
// EdgeClock: when the edges of a motion are due, by CLOCK_MONOTONIC, on a host that may be late.
#pragma once

#include "splinefeed/hal/rt/motion_clock.hpp"

#include <cstdint>

namespace splinefeed::hal::gpio {

struct EdgeClockSettings {
    std::uint64_t guard_ns = 5'000;       ///< the longest of the times that edges must be apart
    std::uint64_t tolerated_ns = 100'000; ///< a later edge stretches time
    std::uint64_t reserve_ns = 20'000'000;
};

/// The motion's time runs with ours. An edge that comes late keeps its distance to the next one up to the guard, so
/// that no pulse and no set-up time is ever shorter than planned, and never is a delay caught up with a burst: later
/// than what is tolerated, the whole motion moves by it.
/// Where the motion's end is not known in time, its time slows down to stand and goes on by the law of MotionClock: the
/// axes stay on the path. Not for several threads at once.
class EdgeClock {
public:
    explicit EdgeClock(const EdgeClockSettings& settings) noexcept : settings_(settings), clock_(settings.reserve_ns) {}

    static constexpr std::uint64_t never = MotionClock::never;

    /// The motion's time is motion_ns at that instant and before. It runs at full rate from here on.
    void start(std::uint64_t at_ns, std::int64_t motion_ns) noexcept;
    /// Its time slows down from that instant on. @pre running
    void stop(std::uint64_t at_ns) noexcept { clock_.stop(at_ns); }
    /// It stands, and begins to move at that instant. @pre at_standstill(at_ns)
    void resume(std::uint64_t at_ns) noexcept { clock_.resume(at_ns); }
    [[nodiscard]] bool stopping() const noexcept { return clock_.stopping(); }
    [[nodiscard]] bool at_standstill(std::uint64_t now_ns) const noexcept { return clock_.at_standstill(now_ns); }

    /// The motion's time at that instant.
    [[nodiscard]] std::int64_t motion_ns(std::uint64_t now_ns) const noexcept;
    /// When edges at this time of the motion are due; never: it stands before.
    [[nodiscard]] std::uint64_t due_ns(std::int64_t motion_ns) const noexcept;
    /// Nothing before that time of the motion is left to be made. Where it is overdue by more than is tolerated, the
    /// whole motion moves, so that it is due now. Returns by how much. To be called before stop().
    std::uint64_t absorb_delay(std::int64_t motion_ns, std::uint64_t now_ns) noexcept;
    /// How late edges at this time of the motion are, if they are made at that instant. @pre due_ns() was not never
    [[nodiscard]] std::uint64_t late_ns(std::int64_t motion_ns, std::uint64_t at_ns) const noexcept;
    /// Whether edges were made since start(), and the motion's time of the last ones.
    [[nodiscard]] bool has_made() const noexcept { return last_motion_ns_ != INT64_MIN; }
    [[nodiscard]] std::int64_t last_motion_ns() const noexcept { return last_motion_ns_; }
    /// They were made, at that instant. Returns how late they were. @pre due_ns() was not never
    std::uint64_t made(std::int64_t motion_ns, std::uint64_t at_ns) noexcept;

    /// By how much the motion was moved, all in all.
    [[nodiscard]] std::uint64_t schedule_slip_ns() const noexcept { return schedule_slip_ns_; }

private:
    [[nodiscard]] std::uint64_t planned_ns(std::int64_t motion_ns) const noexcept;

    EdgeClockSettings settings_;
    MotionClock clock_;
    std::int64_t begin_motion_ns_ = 0; // the motion's time where clock_ began
    std::uint64_t last_ns_ = 0;        // the last edges were made
    std::int64_t last_motion_ns_ = INT64_MIN;
    std::uint64_t schedule_slip_ns_ = 0;
};

} // namespace splinefeed::hal::gpio
