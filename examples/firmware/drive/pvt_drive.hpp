// SPDX-License-Identifier: MIT
// PvtDrive: the behaviour of a drive with the map splinefeed-pvt in time, without its registers: states, commands,
// motion. docs/reference/pvt_map.md defines it.
#pragma once

#include "drive/slot_maker.hpp"

#include "splinefeed/hal/modbus/pvt_drive/pvt_registers.hpp"

#include <array>
#include <optional>

namespace firmware {

using splinefeed::hal::modbus::PvtCommand;
using splinefeed::hal::modbus::PvtConfiguration;
using splinefeed::hal::modbus::PvtFault;
using splinefeed::hal::modbus::PvtRefusal;
using splinefeed::hal::modbus::PvtSegment;
using splinefeed::hal::modbus::PvtState;
using splinefeed::hal::modbus::PvtStatus;

/// Belongs to the main loop; the interrupt makes the steps of the slots. The drive's clock is the count of the ticks.
/// It has no encoders: where the axes are is what was stepped, and there is no following error. It has no reference
/// switches: `home` is refused.
class PvtDrive {
public:
    PvtDrive(DriveSteps& steps, std::span<PvtSegment> ring) noexcept
        : steps_(steps), queue_(ring, static_cast<int>(drive_axes)), path_(queue_) {
        stand(PvtState::disabled);
    }

    /// A round of the main loop: inputs, what is due, the next slots. @param limit  a limit switch is pressed
    void poll(bool limit) noexcept;

    /// Executes a command other than `begin` and `preset_position`; refused if it does not fit the state.
    [[nodiscard]] PvtRefusal execute(PvtCommand command, std::uint32_t argument) noexcept;
    [[nodiscard]] PvtRefusal begin(std::uint16_t session, std::uint32_t first) noexcept;
    [[nodiscard]] PvtRefusal preset_position(std::span<const PvtSegment> segments) noexcept;
    [[nodiscard]] PvtRefusal take(std::uint32_t first, std::span<const PvtSegment> segments) noexcept;
    /// A valid block: restarts the watchdog.
    void feed_watchdog() noexcept { fed_us_ = clock_us(); }

    void configure(const PvtConfiguration& configuration) noexcept { configuration_ = configuration; }
    [[nodiscard]] const PvtConfiguration& configuration() const noexcept { return configuration_; }
    [[nodiscard]] static constexpr int axes() noexcept { return static_cast<int>(drive_axes); }
    [[nodiscard]] std::uint16_t ring_capacity() const noexcept { return queue_.capacity(); }
    /// What PvtRegisters does not count itself.
    [[nodiscard]] PvtStatus status() const noexcept;
    [[nodiscard]] PvtState state() const noexcept { return state_; }
    [[nodiscard]] PvtFault fault() const noexcept { return fault_; }
    [[nodiscard]] unsigned fault_axis() const noexcept { return fault_axis_; }
    /// Nothing after power-up and after the ring was lost.
    [[nodiscard]] std::optional<std::uint16_t> session() const noexcept { return session_; }
    [[nodiscard]] std::uint32_t clock_us() const noexcept { return steps_.ticks() * drive_tick_us; }
    /// Whether the motors shall have power.
    [[nodiscard]] bool powered() const noexcept {
        return state_ != PvtState::disabled && fault_ != PvtFault::emergency_stop;
    }

private:
    enum class Motion : std::uint8_t { none, ring, each_axis };

    [[nodiscard]] PvtRefusal hold(std::uint32_t clock_us) noexcept;
    [[nodiscard]] PvtRefusal quick_stop() noexcept;
    void start_at(std::uint32_t clock_us) noexcept;
    void enable() noexcept;
    void stand(PvtState state) noexcept;
    void stand_where_the_motors_are() noexcept;
    void leave_path() noexcept;
    void lose_ring() noexcept;
    void stop_axes(PvtState meanwhile, PvtState then) noexcept;
    void fail(PvtFault fault, unsigned axis) noexcept;
    void notice_inputs(bool limit) noexcept;
    [[nodiscard]] bool is_beside(const PerAxis<std::int32_t>& place) const noexcept;
    void publish_executed() noexcept;
    void fire_events() noexcept;
    void start_ring() noexcept;
    void slow_down() noexcept;
    void make_slot() noexcept;
    [[nodiscard]] bool follow_ring(AxisPlaces& to) noexcept;
    [[nodiscard]] std::uint32_t ticks_to_hold(std::uint32_t ticks) const noexcept;
    /// In this order: a slot that begins in between is active.
    [[nodiscard]] bool drained() const noexcept { return steps_.level() == 0 && !steps_.active(); }
    [[nodiscard]] bool waits_empty() const noexcept { return queue_.empty() && !start_waits_; }

    DriveSteps& steps_;
    SegmentQueue queue_;
    PathMotion path_;
    SlotMaker slots_;
    MotionPart part_;
    PvtConfiguration configuration_;
    std::array<std::uint32_t, 4> passed_at_{}; // segments that were passed at the ends of the last slots
    std::uint32_t pushed_ = 0;                 // slots
    std::uint32_t reported_ = 0;               // of them, what queue_ knows
    std::uint32_t slot_begin_us_ = 0;          // of the next slot
    std::uint32_t wait_ticks_ = 0;             // of the first slot, before the motion starts
    std::uint32_t start_us_ = 0;
    std::uint32_t hold_us_ = 0;
    std::uint32_t fed_us_ = 0;
    std::optional<std::uint16_t> session_;
    PvtState state_ = PvtState::disabled;
    PvtState then_ = PvtState::disabled; // when the slots have been made
    Motion motion_ = Motion::none;
    PvtFault fault_ = PvtFault::none;
    unsigned fault_axis_ = 0;
    bool ends_ = false; // the last slot of a motion is made
    bool start_waits_ = false;
    bool hold_waits_ = false;
    PerAxis<std::int32_t> pressed_at_{}; // where the limit switch was pressed
    bool on_limit_ = false;
    bool leaving_ = false; // it was pressed without a motion along the ring: one may leave it
};

using PvtRegisters = splinefeed::hal::modbus::PvtRegisters<PvtDrive, static_cast<int>(drive_axes)>;

} // namespace firmware
