// SPDX-License-Identifier: MIT
// SetpointGroup: the drives of a SetpointPort on their buses: made ready together, watched and asked together.
#pragma once

#include "splinefeed/hal/modbus/setpoint/axis_frame.hpp"
#include "splinefeed/hal/modbus/setpoint/setpoint_stop.hpp"
#include "splinefeed/hal/modbus/setpoint/setpoint_watch.hpp"
#include "splinefeed/hal/modbus/setpoint/setpoint_wiring.hpp"
#include "splinefeed/hal/motion_port.hpp"

namespace splinefeed::hal::modbus {

struct SetpointPortSettings {
    std::uint32_t reserve_us = 100'000; ///< motion time of a stop on the path
    PortOrders orders{};                ///< drives home one after the other
    bool (*interrupted)() = nullptr;    ///< polled during prepare(); true: it ends
    std::uint32_t buffer_us = 300'000;  ///< motion that is buffered ahead
    std::uint32_t away_us = 5'000'000;  ///< a drive is offline for this long: the port goes to fault
    LinkTiming timing{};
    MakeWire make_wire = make_link;
    Clock* clock = &system_clock(); ///< must outlive the port
};

/// For one thread; the buses have threads of their own between start() and stop().
class SetpointGroup {
public:
    /// Makes one bus for each wire. The settings must outlive the group.
    SetpointGroup(const std::vector<SetpointWiring>& wiring, const SetpointPortSettings& settings);

    /// Connects to all drives and checks them against their profiles. Nothing moves.
    [[nodiscard]] PortFailure open();
    /// SetpointPort::await_standstill(), placed(). @pre open, not started
    [[nodiscard]] PortFailure await_standstill(const PortOrders& orders) const;
    [[nodiscard]] bool placed(std::size_t i) const noexcept {
        return slots_[i].wiring.profile->keeps_homed() && drive(i).reading().homed;
    }
    /// Whether the drive's counts still mean what they did in the motion before: it was not off meanwhile.
    /// @pre open, not started
    [[nodiscard]] bool keeps_place(std::size_t i) const noexcept;
    /// Enables all drives, homes them if set, and maps their positions to the start of the first segment. Blocks.
    /// @pre open, not started
    /// @param placed  positions that have a meaning keep it
    [[nodiscard]] PortFailure make_ready(const FeedSegment& first, const PortOrders& orders, bool placed = false);
    /// Before another motion: ends the threads, and forgets what the drives did in the motion before.
    void reset() noexcept;
    /// Starts the buses' threads. `motion` must outlive them.
    void start(SetpointMotion& motion);
    void stop() noexcept;

    [[nodiscard]] std::size_t size() const noexcept { return slots_.size(); }
    /// The drive itself. @pre not started
    [[nodiscard]] SetpointDrive& drive(std::size_t i) const noexcept { return slots_[i].bus->drive(slots_[i].index); }
    [[nodiscard]] SetpointReport report(std::size_t i) const noexcept { return slots_[i].bus->report(slots_[i].index); }
    [[nodiscard]] const SetpointWiring& wiring(std::size_t i) const noexcept { return slots_[i].wiring; }
    [[nodiscard]] const AxisFrame& frame(std::size_t i) const noexcept { return slots_[i].frame; }
    /// Whether make_ready() ended while the drive may have been on its way to its reference.
    [[nodiscard]] bool homing(std::size_t i) const noexcept { return slots_[i].homing; }
    [[nodiscard]] bool online(std::size_t i) const noexcept;
    /// How often late targets of a drive stopped all of them.
    [[nodiscard]] std::uint32_t late_stops(std::size_t i) const noexcept {
        return slots_[i].bus->late_stops(slots_[i].index);
    }
    void stop_drive(std::size_t i, StopRequest request) noexcept {
        slots_[i].bus->stop_drive(slots_[i].index, request);
    }

    /// Converts a segment to the drives' positions and notes its deviation. A segment that leaves a drive's range is
    /// unchanged, and that drive is returned.
    [[nodiscard]] std::optional<std::size_t> convert(FeedSegment& segment) noexcept;
    /// The first drive that does not follow, by its reports. @param began_us  start of the motion
    [[nodiscard]] PortFailure watch(std::uint64_t began_us);
    /// The first drive that has not answered since that instant, is not on the path or, with blocks, does not stand;
    /// empty: there is none.
    [[nodiscard]] std::optional<std::size_t> not_ready(std::uint64_t since_us) const noexcept;
    /// The first drive that is not at the end of the motion; empty: there is none.
    [[nodiscard]] std::optional<std::size_t> not_arrived(SetpointMotion& motion) const noexcept;
    /// Whether the positions of all drives are of that instant or later.
    [[nodiscard]] bool heard_since(std::uint64_t since_us) const noexcept;
    /// The window within which a drive is where it ought to be. [counts]
    [[nodiscard]] double tolerance_counts(std::size_t i) const noexcept {
        return slots_[i].wiring.standstill_counts + rounding_counts(slots_[i].wiring, period_us_);
    }

    /// Period of the targets, after open(). [us]
    [[nodiscard]] std::uint32_t period_us() const noexcept { return period_us_; }
    /// How far ahead of the motion's time targets are. [us]
    [[nodiscard]] std::uint64_t ahead_us() const noexcept;
    /// Duration of a few consecutive failed exchanges on the slowest wire. [us]
    [[nodiscard]] std::uint64_t answers_us() const noexcept;
    [[nodiscard]] double deviation_counts(std::size_t i) const noexcept;
    [[nodiscard]] double deviation_bound_counts(std::size_t i) const noexcept;
    [[nodiscard]] std::uint64_t busy_us() const noexcept;

private:
    struct Slot {
        SetpointWiring wiring;
        SetpointBus* bus = nullptr;
        std::size_t index = 0; // index on the bus
        AxisFrame frame;
        double deviation_counts = 0.0; // between two targets
        double speed_counts_s = 0.0;   // largest speed
        SetpointWatch watch;
        bool homing = false;
    };

    [[nodiscard]] PortFailure configure(const PortOrders& orders);
    [[nodiscard]] PortFailure poll_others(std::size_t but, std::size_t enabled) const;

    const SetpointPortSettings* settings_;
    std::vector<std::unique_ptr<SetpointBus>> buses_;
    std::vector<Slot> slots_;
    std::uint32_t period_us_ = 0;
};

} // namespace splinefeed::hal::modbus
