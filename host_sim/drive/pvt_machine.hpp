// SPDX-License-Identifier: MIT
// PvtMachine: the behaviour of a drive with the map splinefeed-pvt in time, without its registers: states, commands,
// motion.
#pragma once

#include "host_sim/drive/axis_moves.hpp"
#include "host_sim/drive/motor_axis.hpp"
#include "host_sim/drive/pvt_axis.hpp"
#include "host_sim/drive/pvt_schedule.hpp"
#include "host_sim/drive/ring_motion.hpp"

#include <vector>

namespace splinefeed::host {

/// Time is in microseconds since the drive was made; the drive's clock is that plus a start value.
class PvtMachine {
public:
    PvtMachine(std::vector<PvtAxisParameters> axes, std::uint16_t ring, std::uint64_t clock_start_us);

    /// Lets time pass. Cost: steps of at most 125 us while something moves, otherwise none.
    void advance(std::uint64_t now_us);
    /// Executes a command other than `begin` and `place`; refused if it does not fit the state.
    [[nodiscard]] hal::modbus::PvtRefusal execute(hal::modbus::PvtCommand command, std::uint32_t argument);
    [[nodiscard]] hal::modbus::PvtRefusal begin(std::uint16_t session, std::uint32_t first);
    [[nodiscard]] hal::modbus::PvtRefusal preset_position(std::span<const hal::modbus::PvtSegment> segments);
    [[nodiscard]] hal::modbus::PvtRefusal take(std::uint32_t first, std::span<const hal::modbus::PvtSegment> segments);
    /// A valid exchange: restarts the watchdog.
    void feed_watchdog() noexcept { schedule_.feed(now_us_); }
    /// Power off and on: shafts stay; everything else is as at the beginning, with another start of the clock.
    void power_cycle(std::uint64_t clock_start_us);

    void configure(const hal::modbus::PvtConfiguration& configuration) noexcept { configuration_ = configuration; }
    [[nodiscard]] const hal::modbus::PvtConfiguration& configuration() const noexcept { return configuration_; }
    /// Sets a function that is called at the end of every segment.
    void observe(std::function<void(const ExecutedSegment&)> observer) { path_.observe(std::move(observer)); }
    [[nodiscard]] MotorAxis& shaft(int axis) noexcept { return shafts_[static_cast<unsigned>(axis)]; }

    [[nodiscard]] int axes() const noexcept { return static_cast<int>(axes_.size()); }
    [[nodiscard]] std::uint16_t ring_capacity() const noexcept { return ring().capacity(); }
    /// What PvtRegisters does not count itself.
    [[nodiscard]] hal::modbus::PvtStatus status() const;
    [[nodiscard]] const MotorAxis& shaft(int axis) const noexcept { return shafts_[static_cast<unsigned>(axis)]; }
    [[nodiscard]] hal::modbus::PvtState state() const noexcept { return state_; }
    [[nodiscard]] hal::modbus::PvtFault fault() const noexcept { return fault_; }
    [[nodiscard]] int fault_axis() const noexcept { return fault_axis_; }
    /// Nothing after power-up and after the ring was lost.
    [[nodiscard]] std::optional<std::uint16_t> session() const noexcept { return session_; }
    [[nodiscard]] const PvtRing& ring() const noexcept { return path_.ring(); }
    [[nodiscard]] double rate() const noexcept { return path_.rate(); }
    [[nodiscard]] std::uint32_t clock_us() const noexcept {
        return static_cast<std::uint32_t>(clock_start_us_ + now_us_);
    }

private:
    using State = hal::modbus::PvtState;
    using Refusal = hal::modbus::PvtRefusal;
    enum class Motion { none, ring, each_axis };

    [[nodiscard]] Refusal hold(std::uint32_t clock_us);
    [[nodiscard]] Refusal quick_stop();
    [[nodiscard]] Refusal home();
    [[nodiscard]] std::uint64_t time_of(std::uint32_t clock_us) const noexcept;
    [[nodiscard]] bool idle() const noexcept;
    [[nodiscard]] bool waits_empty() const noexcept;
    void fire_events();
    void start_ring();
    void slow_down();
    void check_watchdog();
    void step(std::uint64_t duration_us);
    void follow_ring(double duration_s);
    void follow_moves(double duration_s);
    void check_axes(const PerAxis<double>& acceleration);
    void stand(State state);
    void leave_path();
    void move_axes(State meanwhile, State then);
    void stop_axes(State meanwhile, State then);
    void lose_ring();
    void fail(hal::modbus::PvtFault fault, int axis);

    std::vector<PvtAxisParameters> axes_;
    std::vector<MotorAxis> shafts_;
    RingMotion path_;
    AxisMoves moves_;
    PvtSchedule schedule_;
    PvtReference reference_;
    hal::modbus::PvtConfiguration configuration_;
    State state_ = State::disabled;
    State after_moves_ = State::disabled;
    Motion motion_ = Motion::none;
    hal::modbus::PvtFault fault_ = hal::modbus::PvtFault::none;
    int fault_axis_ = 0;
    std::optional<std::uint16_t> session_;
    std::uint64_t now_us_ = 0;
    std::uint64_t clock_start_us_;
};

} // namespace splinefeed::host
