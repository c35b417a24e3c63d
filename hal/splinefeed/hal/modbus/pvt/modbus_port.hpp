// SPDX-License-Identifier: MIT
// ModbusPort: motion port for Modbus drives that buffer and interpolate segments (map splinefeed-pvt), on one bus or
// several. It starts, synchronises and stops the drives together.
#pragma once

#include "splinefeed/hal/modbus/pvt/modbus_bus.hpp"
#include "splinefeed/hal/modbus/pvt/modbus_phases.hpp"
#include "splinefeed/hal/modbus/pvt/pvt_group_stop.hpp"
#include "splinefeed/hal/motion_port.hpp"

namespace splinefeed::hal::modbus {

struct ModbusPortSettings {
    std::uint32_t buffer_us = 400'000;   ///< motion buffered in the drives, limited by their rings
    std::uint32_t stop_reserve_ms = 100; ///< PvtConfiguration; the same for all drives of a run
    std::uint32_t silent_us = 100'000;   ///< a drive without an answer for this long is offline: the others stop
    std::uint32_t away_us = 5'000'000;   ///< offline for this long: the port goes to fault
    PortOrders orders{};
    bool (*interrupted)() = nullptr; ///< polled during homing; true: quick stop
    LinkTiming timing{};
    std::uint32_t first_sequence = 1; ///< sequence number of the first segment; 0 leaves no mark: placed()
    MakeWire make_wire = make_link;
    Clock* clock = &system_clock(); ///< must outlive the port
};

class ModbusPort final : public MotionPort {
public:
    /// Makes one bus for each wire. Constructor, open() and prepare() allocate; submit(), poll() and halt() do not.
    ModbusPort(const std::vector<DriveWiring>& wiring, const ModbusPortSettings& settings);
    ~ModbusPort();

    /// Checks the identity of all drives, and that no other program uses them. Only reads.
    [[nodiscard]] PortFailure open() override;
    /// Shortest segment duration that every bus can carry, measured now. [us] Call between open() and prepare().
    [[nodiscard]] double least_segment_us();
    /// Reads a drive's status once. Call between open() and prepare().
    LinkAnswer probe(std::size_t drive) noexcept { return drives_[drive].client().probe(); }
    /// Waits until no drive moves, so that report() has where it stands. Sends no command, so nothing changes. Returns
    /// the first drive that goes on moving, does not answer, or is in a fault that prepare() will not reset. Call
    /// between open() and prepare().
    [[nodiscard]] PortFailure await_standstill();
    /// Whether the positions that a drive reports are those of a machine: since its power-up a run has set them.
    /// Otherwise they count from anywhere. Before prepare().
    [[nodiscard]] bool placed(std::size_t drive) const noexcept { return report(drive).status.executed != 0; }
    /// Enables all drives, homes them if set, and presets their positions to first.start, where the motion begins.
    /// Behind close() and open() it may be called again.
    [[nodiscard]] PortFailure prepare(const FeedSegment& first) override;
    /// Waits for a command, where the motion before was halted. A drive that lost its power then needs prepare().
    [[nodiscard]] PortFailure renew(const FeedSegment& first) override;
    [[nodiscard]] int room() const noexcept override;
    /// With less motion than this, of which the end is not declared, the drives slow down. [us]
    [[nodiscard]] std::uint64_t least_ahead_us() const noexcept;
    [[nodiscard]] bool submit(const FeedSegment& segment) noexcept override;
    void complete() noexcept override { complete_ = true; }
    PortState poll() noexcept override;
    /// A stop is over when every drive has confirmed it or its time is over: stop_report().
    void halt() noexcept override;
    void quick_stop() noexcept override;
    void power_off() noexcept override;
    void close() noexcept override;
    [[nodiscard]] PortFailure failure() const override;
    /// State of a drive's stop after halt(), quick_stop() or a fault of the port. No stop requested: StopRequest::none.
    [[nodiscard]] StopReport stop_report(std::size_t drive) const noexcept { return stop_.sequence().report(drive); }
    /// Longest duration of a stop, whether the drives answer or not; a drive that brakes needs longer. [us] After
    /// prepare().
    [[nodiscard]] std::uint64_t longest_stop_us() const noexcept { return stop_times_.longest_us(); }

    [[nodiscard]] ModbusPhase phase() const noexcept { return phases_.phase(); }
    [[nodiscard]] const ModbusPhases& phases() const noexcept { return phases_; }
    /// prepare() succeeded: positions of the drives are those of the machine.
    [[nodiscard]] bool referenced() const noexcept { return referenced_; }
    /// Position of a drive's axis [counts]; nothing: its reference was not set in this session, or was lost since.
    [[nodiscard]] std::optional<std::int32_t> known_position(std::size_t drive, std::size_t axis) const noexcept;
    [[nodiscard]] std::size_t drives() const noexcept { return drives_.size(); }
    [[nodiscard]] const DriveWiring& wiring(std::size_t drive) const noexcept { return drives_[drive].wiring(); }
    [[nodiscard]] DriveReport report(std::size_t drive) const noexcept { return drives_[drive].client().report(); }
    /// Largest uncertainty of a drive's clock at any start: the drive may be ahead or behind by this. [us]
    [[nodiscard]] double clock_uncertainty_us(std::size_t drive) const noexcept {
        return drives_[drive].clock_uncertainty_us();
    }
    /// Number of times that all drives stopped for one that was offline or late, and resumed.
    [[nodiscard]] std::uint32_t resumes() const noexcept { return resumes_; }
    /// Processor time of all bus threads. [us]
    [[nodiscard]] std::uint64_t busy_us() const noexcept;

private:
    void update_drives() noexcept;
    [[nodiscard]] PortFailure failed(const DriveFailure& failure);
    [[nodiscard]] PortFailure find_other_master();
    void set_times(const FeedSegment& first) noexcept;
    [[nodiscard]] std::optional<DriveFailure> make_ready();
    void begin_anew() noexcept;
    void begin_motion() noexcept;
    void take(ModbusEvent event) noexcept;
    void fail(std::size_t drive, DriveProblem problem, ModbusEvent event = ModbusEvent::broken) noexcept;
    [[nodiscard]] DriveProblem delay_by(const PortDrive& drive) const noexcept;
    [[nodiscard]] DriveFailure culprit() const noexcept;
    [[nodiscard]] std::optional<ModbusEvent> look() noexcept;
    [[nodiscard]] std::optional<ModbusEvent> look_at_standstill() noexcept;
    [[nodiscard]] std::optional<ModbusEvent> look_at_motion() noexcept;
    [[nodiscard]] bool starts_in_vain() noexcept;
    [[nodiscard]] std::size_t latest() const noexcept;
    [[nodiscard]] bool filled() const noexcept;
    void start() noexcept;
    [[nodiscard]] std::uint64_t start_lead_us() const noexcept;
    [[nodiscard]] std::uint32_t common_end() const noexcept;
    void stop_together() noexcept;
    void begin_stop(StopRequest request, ModbusEvent event = ModbusEvent::stop) noexcept;
    void await_stop() noexcept;
    void follow_stop() noexcept;
    [[nodiscard]] std::uint32_t executed() const noexcept;
    [[nodiscard]] bool accepted_more() noexcept;

    ModbusPortSettings settings_;
    std::vector<std::unique_ptr<ModbusBus>> buses_;
    std::vector<PortDrive> drives_;
    PvtGroupStop stop_;
    StopTimes stop_times_;
    PortTimes times_;
    std::optional<DriveFailure> failure_;
    ModbusPhases phases_{modbus_phase_table(), ModbusPhase::filling};
    ModbusPhaseTimes phase_times_;
    std::uint64_t now_us_ = 0;
    std::uint64_t started_us_ = 0;  // latest instant at which all drives have started
    std::uint64_t executed_ = 0;    // segments executed by all drives
    std::uint32_t executed_to_ = 0; // sequence number of the next one
    std::uint32_t buffer_segments_ = 0;
    std::uint32_t accepted_to_ = 0; // the next sequence numbers of all drives, added up
    std::uint64_t started_at_ = 0;  // executed_ at the last start
    unsigned vain_starts_ = 0;      // in a row, without a segment executed
    std::size_t disturber_ = 0;     // the drive for which all stopped last
    std::uint32_t stop_at_ = 0;
    std::uint32_t resumes_ = 0;
    bool complete_ = false;
    bool prepared_ = false;   // bus threads run
    bool moves_ = false;      // a command of this port may have moved a drive
    bool referenced_ = false; // every drive has confirmed the preset of its position
};

} // namespace splinefeed::hal::modbus
