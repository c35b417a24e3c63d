// SPDX-License-Identifier: MIT
// PvtClient: client of one drive with the map splinefeed-pvt (docs/reference/pvt_map.md). Every segment arrives exactly
// once.
#pragma once

#include "splinefeed/hal/modbus/link/modbus_wire.hpp"
#include "splinefeed/hal/modbus/pvt/drive_report.hpp"

#include <atomic>
#include <mutex>
#include <vector>

namespace splinefeed::hal::modbus {

/// Configuration of a drive for a run; empty members keep the drive's values.
struct PvtSettings {
    std::optional<std::uint16_t> stop_reserve_ms{};
    std::optional<std::uint16_t> watchdog_ms{};
    std::optional<std::uint32_t> following_window{}; ///< [counts]; 0: no check
};

/// For two threads: the port's (push, command, report) and the bus's (step). Allocates in its constructor only.
class PvtClient {
public:
    static constexpr std::size_t queue_capacity = 4096; ///< 0.4 s of the shortest segments

    /// @param link  must outlive the client; shared with the other drives of the bus
    /// @param both_in_one  use function 23, and 16 with 03 if the drive refuses it; false: use 16 with 03
    PvtClient(ModbusWire& link, int unit, bool both_in_one = true);

    /// Connects and checks the identity. As configure() and probe(): @pre the bus is not started
    [[nodiscard]] DriveProblem open(int least_axes) noexcept;
    [[nodiscard]] DriveProblem configure(const PvtSettings& wanted) noexcept;
    /// Reads the status, over a bad line, too.
    [[nodiscard]] DriveProblem read_status() noexcept;
    /// Reads the status once.
    LinkAnswer probe() noexcept;
    [[nodiscard]] int axes() const noexcept { return axes_; }
    [[nodiscard]] int unit() const noexcept { return unit_; }
    [[nodiscard]] const ModbusWire& link() const noexcept { return *link_; }

    // For the port's thread.
    /// Number of segments that push() accepts now. Executed segments make room.
    [[nodiscard]] std::size_t room() const noexcept;
    /// Returns false, and takes nothing, if there is no room.
    [[nodiscard]] bool push(const PvtSegment& segment) noexcept;
    /// Sequence number of the first segment of the session.
    [[nodiscard]] std::uint32_t first() const noexcept { return first_; }
    [[nodiscard]] std::uint32_t pushed() const noexcept { return tail_.load(std::memory_order_relaxed); }
    /// A pushed segment. @pre it is the last executed one or a later one
    [[nodiscard]] const PvtSegment& segment(std::uint32_t sequence) const noexcept {
        return queue_[sequence % queue_capacity];
    }
    /// Sends a command, before any further segments. The argument of `begin` is the number of the next pushed segment.
    /// @pre no command is pending
    void command(PvtCommand command, std::uint32_t argument = 0, const PvtSegment& preset = {}) noexcept;
    /// The same, but replaces a pending command. If the replaced command still arrives after this one was executed, the
    /// drive ignores it.
    void interrupt(PvtCommand command, std::uint32_t argument = 0) noexcept;
    /// While true, no segments are sent, so the drive keeps its last segment.
    void hold_back(bool on) noexcept { held_back_.store(on, std::memory_order_relaxed); }
    [[nodiscard]] DriveReport report() const noexcept;
    /// ClockEstimate::drive_us of the drive's clock. @pre the clock is known
    [[nodiscard]] std::int64_t drive_us(std::uint64_t host_us) const noexcept;

    // For the bus's thread.
    /// Makes one exchange if there is something to send or the status is old. Returns false if nothing was due.
    bool step() noexcept;

private:
    struct PendingCommand {
        PvtCommand command = PvtCommand::none;
        std::uint32_t argument = 0;
        PvtSegment preset;
    };

    [[nodiscard]] DriveProblem start_session(int least_axes) noexcept;
    [[nodiscard]] DriveProblem change_configuration(const PvtSettings& wanted) noexcept;
    [[nodiscard]] bool due(std::uint64_t now_us, std::uint32_t waiting) const noexcept;
    void fill(PvtBlock& block, std::uint32_t waiting) noexcept;
    void handle_answer(const LinkAnswer& answer, const PvtBlock& block, std::span<const std::uint16_t> raw) noexcept;
    [[nodiscard]] DriveProblem check_status(const PvtStatus& status) const noexcept;
    void publish_report(const PvtStatus& status, const PvtBlock& block) noexcept;
    void sample_clock(const LinkAnswer& answer) noexcept;
    void resolve_command(const PvtStatus& status, const PvtBlock& block) noexcept;
    void clear_command() noexcept;
    bool reconnect(std::uint64_t now_us) noexcept;
    LinkAnswer exchange(std::span<const std::uint16_t> block, std::span<std::uint16_t> status) noexcept;

    ModbusWire* link_;
    int unit_;
    int axes_ = 0;
    std::vector<PvtSegment> queue_; // by sequence number, from executed to pushed
    std::atomic<std::uint32_t> head_{0};
    std::atomic<std::uint32_t> tail_{0};
    std::atomic<bool> held_back_{false};
    PvtSegments batch_{}; // segments of one block
    PvtBlockRegisters block_{};

    mutable std::mutex mutex_; // guards the members below
    DriveReport report_;
    PendingCommand pending_;

    std::uint64_t executed_ = 0; // executed in this session
    std::uint64_t last_exchange_us_ = 0;
    std::uint64_t last_connect_us_ = 0;
    std::uint32_t first_ = 0; // sequence number of the session
    std::uint32_t sent_ = 0;  // one more than the last number sent
    std::uint16_t nonce_ = 0;
    std::uint16_t session_ = 0;
    std::uint16_t counter_ = 0;
    std::uint16_t refusals_in_row_ = 0;
    bool both_in_one_;   // function 23
    bool began_ = false; // session is open
};

} // namespace splinefeed::hal::modbus
