// SPDX-License-Identifier: MIT
// SetpointBus: one wire with drives that get targets, and the thread that sends each drive a target in every period.
#pragma once

#include "splinefeed/hal/modbus/setpoint/setpoint_drive.hpp"
#include "splinefeed/hal/modbus/setpoint/stream_cost.hpp"
#include "splinefeed/hal/rt/motion_clock.hpp"
#include "splinefeed/hal/standstill.hpp"

#include <atomic>
#include <cmath>
#include <deque>
#include <mutex>

namespace splinefeed::hal::modbus {

/// State that the buses of a port share. Its mutex is held while a frame is computed.
struct SetpointMotion {
    SetpointMotion(std::size_t segments, std::uint32_t reserve_us)
        : trajectory(segments), clock(reserve_us), reserve(reserve_us) {}

    /// Motion time at that instant. [us] If the trajectory is about to run out before the end of the motion, the clock
    /// begins to stop.
    [[nodiscard]] std::uint64_t time_us(std::uint64_t now_us) noexcept;

    std::mutex mutex;
    TrajectoryBuffer trajectory;
    MotionClock clock;
    std::uint64_t reserve;              ///< motion time of the clock's slow-down [us]
    std::uint64_t ahead_us = 0;         ///< how far targets are ahead of motion time [us]
    std::uint64_t last_setpoint_us = 0; ///< arrival of the last target at any drive [us]
    std::uint64_t runs_from_us = 0;     ///< when the clock began to run, or resumed; 0: it did not
    bool complete = false;              ///< the trajectory contains the end of the motion, at rest
    bool stop_requested = false;        ///< a stop was requested: drives that stand must not move any more
};

/// State of a drive of a bus. Instants are of the line's clock.
struct SetpointReport {
    DriveReading reading;
    std::uint64_t answered_us = 0;
    std::uint64_t status_us = 0;              ///< earliest instant of `reading`; 0: none since start()
    std::uint64_t position_us = 0;            ///< earliest instant of its position
    bool lost = false;                        ///< it was off, or may have been: its counts may mean another place
    std::uint64_t still_us = 0;               ///< for how long it had stood at last, by its word or its positions
    std::uint64_t setpoint_us = 0;            ///< arrival of the last target; 0: none
    std::uint64_t rest_setpoint_us = 0;       ///< arrival of the first one since the motion's clock stood last; 0: none
    StopRequest executed = StopRequest::none; ///< strongest executed request of stop_drive()
    std::uint64_t executed_us = 0;
    LinkCounts counts;
    std::uint64_t late_us = 0; ///< largest lateness of a target, beyond a period after the previous one
    LinkAnswer last;           ///< of the last exchange
    bool clamped = false;
    bool end_sent = false;
    bool behind = false;   ///< it comes back to the path; always false for drives with blocks
    bool at_target = true; ///< it stands at its target; always true for cyclic drives
};

/// A drive stands when its position has stayed within its window, or it has said so, for this long. [us]
inline constexpr std::uint64_t standstill_us = 40'000;

class SetpointBus {
public:
    /// A target that is later than this, beyond a period, stops all drives. [us]
    static constexpr std::uint32_t allowed_late_us = 20'000;
    /// A drive that was silent for longer may have been switched off and on. [us]
    static constexpr std::uint64_t restart_us = 1'000'000;

    explicit SetpointBus(std::unique_ptr<ModbusWire> link) : link_(std::move(link)) {}
    SetpointBus(const SetpointBus&) = delete;
    SetpointBus& operator=(const SetpointBus&) = delete;
    ~SetpointBus() { stop(); }

    /// Adds a drive. References stay valid. @pre not started
    SetpointDrive& add(const DriveProfile& profile, int unit, double standstill_counts);
    [[nodiscard]] ModbusWire& link() noexcept { return *link_; }
    [[nodiscard]] std::size_t drives() const noexcept { return drives_.size(); }
    [[nodiscard]] SetpointDrive& drive(std::size_t i) noexcept { return drives_[i].drive; }

    /// Shortest period in which the bus can send every drive a target and read the status of one: by the line's rate,
    /// or measured on a tcp link. [us] @pre the drives are open
    [[nodiscard]] std::uint32_t shortest_period_us();
    /// Starts the thread, which sends every drive a target in each period. If targets are too late, it stops the
    /// motion's clock. `motion` must outlive the bus.
    void start(SetpointMotion& motion, std::uint32_t period_us);
    void stop() noexcept;
    /// Before another motion: stop(), and what the drives did in the motion before is forgotten.
    void reset() noexcept;
    [[nodiscard]] SetpointReport report(std::size_t drive) const noexcept;
    /// How often late targets of a drive stopped the clock.
    [[nodiscard]] std::uint32_t late_stops(std::size_t drive) const noexcept {
        return drives_[drive].late_stops.load(std::memory_order_relaxed);
    }
    /// What a drive counts means a place from now on (false), or does not any more: until it is found again.
    void set_lost(std::size_t drive, bool lost) noexcept;
    /// Processor time that the thread has used. [us]
    [[nodiscard]] std::uint64_t busy_us() const noexcept { return busy_us_.load(std::memory_order_relaxed); }
    /// Stops a drive: sends the request with precedence, repeatedly, until the drive has answered. The drive gets no
    /// more targets. @pre request >= StopRequest::quick_stop
    void stop_drive(std::size_t drive, StopRequest request) noexcept {
        drives_[drive].stop_request.store(request, std::memory_order_relaxed);
    }

private:
    struct Slot {
        Slot(const DriveProfile& profile, ModbusWire& link, int unit, double standstill_counts)
            : drive(profile, link, unit), standstill(std::llround(standstill_counts * (1 << physical_bits))) {}

        SetpointDrive drive;
        SetpointReport report;
        Standstill standstill;
        std::uint64_t position_us = 0;   // of the last position in `standstill`
        std::uint64_t word_since_us = 0; // it says that it stands since then; 0: it does not
        std::uint64_t heard_us = 0;      // it answered last; 0: not since start()
        std::uint64_t back_us = 0;      // since then it answers again; 0: it was not silent, or a status has come since
        std::uint64_t off_since_us = 0; // it reports that it is off, or nothing that it knows; 0: it does not
        std::atomic<StopRequest> stop_request{StopRequest::none};
        std::atomic<std::uint32_t> late_stops{0};
        std::uint64_t setpoint_us = 0;      // arrival of the last target; 0: none
        std::uint64_t rest_setpoint_us = 0; // SetpointReport
        std::uint64_t end_sent_us = 0;      // when the end was sent; 0: not yet
        std::uint64_t path_rest_us = 0;     // path and model of the drive stand since then; 0: they move
    };

    void run(SetpointMotion& motion, std::uint32_t period_us) noexcept;
    void send_setpoint(Slot& slot, SetpointMotion& motion, std::uint32_t period_us) noexcept;
    static void check_lateness(Slot& slot, SetpointMotion& motion, std::uint64_t now_us,
                               std::uint32_t period_us) noexcept;
    void on_sent(Slot& slot, SetpointMotion& motion, bool sent, std::uint64_t arrives_us,
                 std::uint32_t period_us) noexcept;
    void publish_report(Slot& slot) noexcept;
    static void note_loss(Slot& slot, std::uint64_t status_us) noexcept;
    void carry_out(Slot& slot, StopRequest request) noexcept;
    void read_statuses() noexcept;
    void run_period(SetpointMotion& motion, std::uint32_t period_us) noexcept;

    std::unique_ptr<ModbusWire> link_;
    std::deque<Slot> drives_;
    mutable std::mutex mutex_; // guards the reports
    std::unique_ptr<ClockThread> thread_;
    std::atomic<bool> stopping_{false};
    std::size_t next_read_ = 0; // drive whose status is read next
    std::atomic<std::uint64_t> busy_us_{0};
};

} // namespace splinefeed::hal::modbus
