// SPDX-License-Identifier: MIT
// EdgeClock: schedule of a motion's edges on CLOCK_MONOTONIC, for a host that may be late.
#pragma once

#include "splinefeed/hal/rt/motion_clock.hpp"

#include <cstdint>

namespace splinefeed::hal::gpio {

struct EdgeClockSettings {
    std::uint64_t guard_ns = 5'000;       ///< the longest of the minimum times between edges
    std::uint64_t tolerated_ns = 100'000; ///< an edge that is later than this delays the whole motion
    std::uint64_t reserve_ns = 20'000'000;
};

/// Motion time advances with host time. After a late edge the next one keeps its planned distance, up to the guard
/// time, so no pulse and no set-up time becomes shorter than planned. An edge that is later than the tolerance delays
/// the whole motion by its lateness; lost time is not made up. If segments run out, stop() and resume() slow motion
/// time down to standstill and up again as MotionClock does: the axes stay on the path. Not thread-safe.
class EdgeClock {
public:
    explicit EdgeClock(const EdgeClockSettings& settings) noexcept : settings_(settings), clock_(settings.reserve_ns) {}

    static constexpr std::uint64_t never = MotionClock::never;

    /// Motion time is motion_ns up to that instant, and advances at rate 1 from there on.
    void start(std::uint64_t at_ns, std::int64_t motion_ns) noexcept;
    /// Begins to slow down at that instant, within twice the settings' reserve or another one. @pre running
    void stop(std::uint64_t at_ns) noexcept { clock_.stop(at_ns); }
    void stop(std::uint64_t at_ns, std::uint64_t reserve_ns) noexcept { clock_.stop(at_ns, reserve_ns); }
    /// Begins to speed up from standstill at that instant. @pre at_standstill(at_ns)
    void resume(std::uint64_t at_ns) noexcept { clock_.resume(at_ns); }
    [[nodiscard]] bool stopping() const noexcept { return clock_.stopping(); }
    [[nodiscard]] bool at_standstill(std::uint64_t now_ns) const noexcept { return clock_.at_standstill(now_ns); }

    /// Motion time at that instant.
    [[nodiscard]] std::int64_t motion_ns(std::uint64_t now_ns) const noexcept;
    /// When edges at this motion time are due; `never`: motion time stops before it.
    [[nodiscard]] std::uint64_t due_ns(std::int64_t motion_ns) const noexcept;
    /// Call with the motion time of the next edge, before stop(). If that edge is overdue by more than the tolerance,
    /// the whole motion is delayed so that the edge is due now. Returns the delay, or 0. [ns]
    std::uint64_t absorb_delay(std::int64_t motion_ns, std::uint64_t now_ns) noexcept;
    /// Lateness of edges at this motion time if they are written at that instant. [ns] @pre due_ns() was not `never`
    [[nodiscard]] std::uint64_t late_ns(std::int64_t motion_ns, std::uint64_t at_ns) const noexcept;
    /// Whether edges were written since start(), and the motion time of the last ones.
    [[nodiscard]] bool has_made() const noexcept { return last_motion_ns_ != INT64_MIN; }
    [[nodiscard]] std::int64_t last_motion_ns() const noexcept { return last_motion_ns_; }
    /// Records that edges were written at that instant. Returns their lateness. [ns] @pre due_ns() was not `never`
    std::uint64_t made(std::int64_t motion_ns, std::uint64_t at_ns) noexcept;

    /// Total delay of the motion. [ns]
    [[nodiscard]] std::uint64_t schedule_slip_ns() const noexcept { return schedule_slip_ns_; }

private:
    [[nodiscard]] std::uint64_t planned_ns(std::int64_t motion_ns) const noexcept;

    EdgeClockSettings settings_;
    MotionClock clock_;
    std::int64_t begin_motion_ns_ = 0; // motion time at the start of clock_
    std::uint64_t last_ns_ = 0;        // instant of the last edges
    std::int64_t last_motion_ns_ = INT64_MIN;
    std::uint64_t schedule_slip_ns_ = 0;
};

} // namespace splinefeed::hal::gpio
