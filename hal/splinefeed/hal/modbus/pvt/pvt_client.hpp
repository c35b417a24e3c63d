// SPDX-License-Identifier: MIT
// PvtClient: our side of one drive with the map splinefeed-pvt (docs/reference/pvt_map.md): every segment arrives, and
// each once.
#pragma once

#include "splinefeed/hal/modbus/link/link_counts.hpp"
#include "splinefeed/hal/modbus/link/modbus_line.hpp"
#include "splinefeed/hal/modbus/pvt/clock_estimate.hpp"
#include "splinefeed/hal/modbus/pvt/drive_problem.hpp"
#include "splinefeed/hal/modbus/pvt/pvt_map.hpp"

#include <atomic>
#include <mutex>
#include <vector>

namespace splinefeed::hal::modbus {

/// What a run asks of a drive's configuration; what it does not name stays as the drive has it.
struct PvtSettings {
    std::optional<std::uint16_t> stop_reserve_ms{};
    std::optional<std::uint16_t> watchdog_ms{};
    std::optional<std::uint32_t> following_window{}; ///< [counts]; 0: none
};

/// A drive as it was at its last good answer.
struct DriveReport {
    PvtIdentity identity;
    PvtStatus status;
    ClockEstimate clock;
    LinkCounts counts;
    DriveProblem problem = DriveProblem::none;
    LinkFault last_fault = LinkFault::none;
    std::uint8_t exception = 0;    ///< with LinkFault::exception
    bool command_pending = false;  ///< the last command() is still under way
    bool command_refused = false;  ///< it was refused, in the state in which the drive was
    std::uint64_t answered_us = 0; ///< the line's clock, of the last good answer
    std::uint64_t status_us = 0;   ///< and when the drive said it, at the earliest
};

/// Two threads use it: the planner's (push, command, report) and the bus's (step). It allocates when it is made.
class PvtClient {
public:
    static constexpr std::size_t queue_capacity = 2048;

    /// @param link  must outlive it; shared with the other drives of the bus
    /// @param both_in_one  the drive has function 23; else 16 and 03, and so where it refuses 23
    PvtClient(ModbusLine& link, int unit, bool both_in_one = true);

    /// Connects and checks who is there. As the next two before the bus runs.
    [[nodiscard]] DriveProblem open(int least_axes) noexcept;
    [[nodiscard]] DriveProblem configure(const PvtSettings& wanted) noexcept;
    /// Reads the status once.
    LinkAnswer probe() noexcept;
    [[nodiscard]] int axes() const noexcept { return axes_; }
    [[nodiscard]] int unit() const noexcept { return unit_; }
    [[nodiscard]] const ModbusLine& link() const noexcept { return *link_; }

    // The planner's side.
    /// Segments that push takes now: what was executed makes room.
    [[nodiscard]] std::size_t room() const noexcept;
    /// @pre room() > 0
    void push(const PvtSegment& segment) noexcept;
    [[nodiscard]] std::uint32_t pushed() const noexcept { return tail_.load(std::memory_order_relaxed); }
    /// A segment that was pushed. @pre it was executed just now, or not yet
    [[nodiscard]] const PvtSegment& segment(std::uint32_t sequence) const noexcept {
        return queue_[sequence % queue_capacity];
    }
    /// By this status the drive stands where the segment that comes next starts.
    [[nodiscard]] bool at_joint(const PvtStatus& status) const noexcept;
    /// Has the drive carry out a command, before any more segments. `begin` has the number of the next segment that is
    /// pushed as its argument. @pre none is pending
    void command(PvtCommand command, std::uint32_t argument = 0, const PvtSegment& preset = {}) noexcept;
    /// The same, in place of one that is pending: should that one still arrive, the drive does not execute it any more
    /// once it has executed this one.
    void interrupt(PvtCommand command, std::uint32_t argument = 0) noexcept;
    /// While true no segments are sent: the drive has the end that it is to have.
    void hold_back(bool on) noexcept { held_back_.store(on, std::memory_order_relaxed); }
    [[nodiscard]] DriveReport report() const noexcept;
    /// ClockEstimate::drive_us of the report's clock. @pre it is known
    [[nodiscard]] std::int64_t drive_us(std::uint64_t host_us) const noexcept;

    // The bus's side.
    /// One exchange, if there is something to say or the drive was not heard for a while. False: nothing was due.
    bool step() noexcept;

private:
    struct PendingCommand {
        PvtCommand command = PvtCommand::none;
        std::uint32_t argument = 0;
        PvtSegment preset;
    };

    template <class Attempt>
    [[nodiscard]] bool retry(const Attempt& attempt) noexcept;
    [[nodiscard]] bool read_status() noexcept;
    [[nodiscard]] bool due(std::uint64_t now_us, std::uint32_t waiting) const noexcept;
    void fill(PvtBlock& block, std::uint32_t waiting) noexcept;
    void handle_answer(const LinkAnswer& answer, const PvtBlock& block, std::span<const std::uint16_t> raw) noexcept;
    [[nodiscard]] DriveProblem check_status(const PvtStatus& status) const noexcept;
    void publish_report(const PvtStatus& status, const PvtBlock& block) noexcept;
    void sample_clock(const LinkAnswer& answer) noexcept;
    void resolve_command(const PvtStatus& status, const PvtBlock& block) noexcept;
    void clear_command() noexcept;
    void count(const LinkAnswer& answer) noexcept;
    bool reconnect(std::uint64_t now_us) noexcept;
    LinkAnswer exchange(std::span<const std::uint16_t> block, std::span<std::uint16_t> status) noexcept;

    ModbusLine* link_;
    int unit_;
    int axes_ = 0;
    std::vector<PvtSegment> queue_; // by sequence number; from executed to pushed
    std::atomic<std::uint32_t> head_{0};
    std::atomic<std::uint32_t> tail_{0};
    std::atomic<bool> held_back_{false};
    PvtSegments batch_{}; // of one block
    PvtBlockRegisters block_{};

    mutable std::mutex mutex_; // of what follows
    DriveReport report_;
    PendingCommand pending_;

    std::uint64_t executed_ = 0; // of the session
    std::uint64_t last_exchange_us_ = 0;
    std::uint64_t last_connect_us_ = 0;
    std::uint32_t sent_ = 0; // beyond the last segment that was ever sent
    std::uint16_t nonce_ = 0;
    std::uint16_t session_ = 0;
    std::uint16_t counter_ = 0;
    std::uint16_t refusals_in_row_ = 0;
    bool both_in_one_;   // function 23
    bool began_ = false; // the session
};

} // namespace splinefeed::hal::modbus
