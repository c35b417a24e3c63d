// SPDX-License-Identifier: MIT
// SetpointBus: one wire with drives that get targets, and the thread that tells each of them where to be, period by
// period.
#pragma once

#include "splinefeed/hal/modbus/setpoint/setpoint_drive.hpp"
#include "splinefeed/hal/modbus/setpoint/stream_cost.hpp"
#include "splinefeed/hal/rt/motion_clock.hpp"
#include "splinefeed/hal/standstill.hpp"

#include <atomic>
#include <deque>
#include <mutex>

namespace splinefeed::hal::modbus {

/// What the buses of a port share. Locked for as long as a frame is computed.
struct SetpointMotion {
    SetpointMotion(std::size_t segments, std::uint32_t reserve_us)
        : trajectory(segments), clock(reserve_us), reserve(reserve_us) {}

    /// The motion's time at that instant. Where the trajectory is about to end before the motion does, it begins to
    /// stop.
    [[nodiscard]] std::uint64_t time_us(std::uint64_t now_us) noexcept;

    std::mutex mutex;
    TrajectoryBuffer trajectory;
    MotionClock clock;
    std::uint64_t reserve;              ///< motion on which it comes to a stop [us]
    std::uint64_t ahead_us = 0;         ///< how far ahead of its time targets are
    std::uint64_t last_setpoint_us = 0; ///< when the last target arrived at any drive
    bool complete = false;              ///< the trajectory has the end of the motion
    bool stop_requested = false;        ///< a stop was asked for: who stands is not to move any more
};

/// How a drive of a bus does.
struct SetpointReport {
    DriveReading reading;
    std::uint64_t answered_us = 0;
    std::uint64_t status_us = 0;   ///< when it said the reading, at the earliest; 0: it has not yet, while it runs
    std::uint64_t still_us = 0;    ///< for how long its position has not changed by then
    std::uint64_t setpoint_us = 0; ///< when the last target arrived; 0: none did
    StopRequest executed = StopRequest::none; ///< of what stop() asked for
    std::uint64_t executed_us = 0;
    LinkCounts counts;
    std::uint64_t late_us = 0;         ///< most that a target came later than a period after the one before
    LinkFault fault = LinkFault::none; ///< of the last exchange
    bool clamped = false;
    bool end_sent = false;
    bool at_target = true; ///< it is where it was told to be, or is told that each period
};

/// A position that has not changed for this long stands. [us]
inline constexpr std::uint64_t standstill_us = 40'000;

class SetpointBus {
public:
    /// A target that comes later than this, beyond a period, has all stop. [us]
    static constexpr std::uint32_t allowed_late_us = 20'000;

    explicit SetpointBus(std::unique_ptr<ModbusLine> link) : link_(std::move(link)) {}
    SetpointBus(const SetpointBus&) = delete;
    SetpointBus& operator=(const SetpointBus&) = delete;
    ~SetpointBus() { stop(); }

    /// Before start(). References stay valid.
    SetpointDrive& add(const DriveProfile& profile, int unit);
    [[nodiscard]] ModbusLine& link() noexcept { return *link_; }
    [[nodiscard]] std::size_t drives() const noexcept { return drives_.size(); }
    [[nodiscard]] SetpointDrive& drive(std::size_t i) noexcept { return drives_[i].drive; }

    /// The shortest period in which every drive gets its target and one its status read: by the line's rate, or
    /// measured on a tcp link. [us] The drives are open.
    [[nodiscard]] std::uint32_t shortest_period_us();
    /// Tells every drive where to be, each period, from now on; the motion must outlive it. Where that comes too late
    /// it has the motion stop.
    void start(SetpointMotion& motion, std::uint32_t period_us);
    void stop() noexcept;
    [[nodiscard]] SetpointReport report(std::size_t drive) const noexcept;
    /// Processor time of the thread. [us]
    [[nodiscard]] std::uint64_t busy_us() const noexcept { return busy_us_.load(std::memory_order_relaxed); }
    /// Has a drive stop, ahead of everything, again and again until it has answered; from then on it gets no targets.
    /// @pre a quick stop or more
    void stop_drive(std::size_t drive, StopRequest request) noexcept {
        drives_[drive].stop_request.store(request, std::memory_order_relaxed);
    }

private:
    struct Slot {
        Slot(const DriveProfile& profile, ModbusLine& link, int unit) : drive(profile, link, unit) {}

        SetpointDrive drive;
        SetpointReport report;
        Standstill standstill{2 << physical_bits};
        std::atomic<StopRequest> stop_request{StopRequest::none};
        std::uint64_t setpoint_us = 0;  // when the last target arrived; 0: none did
        std::uint64_t end_sent_us = 0;  // when it was told the end; 0: not yet
        std::uint64_t path_rest_us = 0; // the path stands since then, and so should the drive; 0: it does not
    };

    void run(SetpointMotion& motion, std::uint32_t period_us) noexcept;
    void send_setpoint(Slot& slot, SetpointMotion& motion, std::uint32_t period_us) noexcept;
    static void check_lateness(const Slot& slot, SetpointMotion& motion, std::uint64_t now_us,
                               std::uint32_t period_us) noexcept;
    void on_sent(Slot& slot, SetpointMotion& motion, bool sent, std::uint32_t period_us) noexcept;
    void publish_report(Slot& slot) noexcept;
    void carry_out(Slot& slot, StopRequest request) noexcept;
    void read_statuses() noexcept;
    void run_period(SetpointMotion& motion, std::uint32_t period_us) noexcept;

    std::unique_ptr<ModbusLine> link_;
    std::deque<Slot> drives_;
    mutable std::mutex mutex_; // of the reports
    std::unique_ptr<ClockThread> thread_;
    std::atomic<bool> stopping_{false};
    std::size_t next_read_ = 0; // of the statuses
    std::atomic<std::uint64_t> busy_us_{0};
};

} // namespace splinefeed::hal::modbus
