// SPDX-License-Identifier: MIT
// ModbusPort: a motion port whose axes are drives on Modbus that interpolate on their own (map splinefeed-pvt), on one
// bus or several. It starts them together, keeps them together, and stops them together.
//
//     filling -> starting -> running ----------------------------> idle (all executed, at rest)
//                   ^           | a drive is about to run dry
//                   |           v
//                waiting <- stopping: every drive to the end of the same segment
#pragma once

#include "splinefeed/hal/modbus/pvt/modbus_bus.hpp"
#include "splinefeed/hal/modbus/pvt/pvt_group_stop.hpp"
#include "splinefeed/hal/motion_port.hpp"

#include <optional>

namespace splinefeed::hal::modbus {

struct ModbusPortSettings {
    std::uint32_t buffer_us = 400'000;   ///< motion that the drives hold ahead, where their rings do
    std::uint32_t stop_reserve_ms = 100; ///< PvtConfiguration; all drives of a run have the same
    std::uint32_t silent_us = 100'000;   ///< a drive that was not heard for this long is away: the others stop
    std::uint32_t away_us = 5'000'000;   ///< and for this long: the port gives up
    bool home = false;                   ///< prepare() has the drives find their references first
    bool (*interrupted)() = nullptr;     ///< asked meanwhile: a quick stop
    LinkTiming timing{};
    std::uint32_t first_sequence = 0; ///< number of the first segment
    MakeLine make_line = make_link;
    Clock* clock = &system_clock(); ///< outlives the port
};

/// What the port does.
enum class ModbusPhase : std::uint8_t { filling, starting, running, stopping, waiting, halting, halted, done, fault };

class ModbusPort final : public MotionPort {
public:
    /// One bus for each wire. It allocates, as open() and prepare() do; submit, poll and halt do not.
    ModbusPort(const std::vector<DriveWiring>& wiring, const ModbusPortSettings& settings);
    ModbusPort(const ModbusPort&) = delete;
    ModbusPort& operator=(const ModbusPort&) = delete;
    ~ModbusPort();

    /// Connects to all drives and looks whether they are what they should be. Nothing moves.
    [[nodiscard]] std::optional<DriveFailure> open();
    /// Shortest duration of a segment that every bus can carry, measured on it now. [us] After open(), before
    /// prepare().
    [[nodiscard]] double least_segment_us();
    /// Reads a drive's status once. After open(), before prepare().
    LinkAnswer probe(std::size_t drive) noexcept { return drives_[drive].client().probe(); }
    /// Enables all drives, homes them if so set, and calls where they stand `start`: a feed segment's start, from which
    /// the motion begins.
    [[nodiscard]] std::optional<DriveFailure> prepare(const FeedSegment& first);
    /// Every axis stops as hard as it can, off the path, ahead of everything else. Ends like halt(): when every drive
    /// has confirmed its stop, or did not within its time; stop_report() says which.
    void quick_stop() noexcept;
    /// Switches every drive's power off; waits until each has confirmed it, or stop_report() says that it did not. @pre
    /// they stand
    void power_off() noexcept;
    /// How a drive was stopped: by halt(), quick_stop(), or because the port is in fault. Nothing asked for: request
    /// none.
    [[nodiscard]] StopReport stop_report(std::size_t drive) const noexcept { return stop_.sequence().report(drive); }
    /// The longest that a stop takes, whatever answers. [us] After prepare().
    [[nodiscard]] std::uint64_t longest_stop_us() const noexcept;
    /// No more segments come.
    void complete() noexcept { complete_ = true; }

    [[nodiscard]] ModbusPhase phase() const noexcept { return phase_; }
    /// Why it is in fault, or why it did not take a segment.
    [[nodiscard]] const std::optional<DriveFailure>& failure() const noexcept { return failure_; }
    [[nodiscard]] std::size_t drives() const noexcept { return drives_.size(); }
    [[nodiscard]] const DriveWiring& wiring(std::size_t drive) const noexcept { return drives_[drive].wiring(); }
    [[nodiscard]] DriveReport report(std::size_t drive) const noexcept { return drives_[drive].client().report(); }
    /// Within what a drive's clock was known when all were started, at the worst: so far it may be ahead or behind.
    /// [us]
    [[nodiscard]] double clock_uncertainty_us(std::size_t drive) const noexcept {
        return drives_[drive].clock_uncertainty_us();
    }
    /// How often all drives stopped for one that was away or late, and went on again.
    [[nodiscard]] std::uint32_t resumes() const noexcept { return resumes_; }
    /// Processor time of the threads of all buses. [us]
    [[nodiscard]] std::uint64_t busy_us() const noexcept;
    /// Ends the threads. What still moves is held first. The drives stay enabled and stand.
    void close() noexcept;

private:
    [[nodiscard]] int do_room() const noexcept override;
    [[nodiscard]] bool do_submit(const FeedSegment& segment) noexcept override;
    PortState do_poll() noexcept override;
    void do_halt() noexcept override;

    void update_drives() noexcept;
    void enter(ModbusPhase phase) noexcept;
    void fail(std::size_t drive, DriveProblem problem) noexcept;
    [[nodiscard]] bool filled() const noexcept;
    void start() noexcept;
    [[nodiscard]] std::uint64_t start_lead_us() const noexcept;
    void check_drives() noexcept;
    void stop_together() noexcept;
    [[nodiscard]] bool all_at_standstill() const noexcept;
    void await_all() noexcept;
    void begin_stop(StopRequest request) noexcept;
    void follow_stop() noexcept;
    void await_stop() noexcept;
    [[nodiscard]] std::uint32_t executed() const noexcept;

    ModbusPortSettings settings_;
    std::vector<std::unique_ptr<ModbusBus>> buses_;
    std::vector<PortDrive> drives_;
    PvtGroupStop stop_;
    StopTimes stop_times_;
    PortTimes times_;
    std::optional<DriveFailure> failure_;
    ModbusPhase phase_ = ModbusPhase::filling;
    std::uint64_t entered_us_ = 0; // the phase
    std::uint64_t now_us_ = 0;
    std::uint64_t started_us_ = 0;  // all run since then
    std::uint64_t executed_ = 0;    // by all drives
    std::uint32_t executed_to_ = 0; // the number of the next one
    std::uint32_t buffer_segments_ = 0;
    std::uint32_t stop_at_ = 0;
    std::uint32_t resumes_ = 0;
    int axes_ = 0; // of the machine
    bool complete_ = false;
    bool prepared_ = false; // the buses run
};

} // namespace splinefeed::hal::modbus
