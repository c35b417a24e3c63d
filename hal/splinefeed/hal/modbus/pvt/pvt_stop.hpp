// SPDX-License-Identifier: MIT
// PvtStop: stops one drive with the map splinefeed-pvt: chooses the command for its state and reports the facts for
// StopSequence.
#pragma once

#include "splinefeed/hal/modbus/pvt/port_times.hpp"
#include "splinefeed/hal/modbus/pvt/pvt_client.hpp"
#include "splinefeed/hal/standstill.hpp"
#include "splinefeed/hal/stop_sequence.hpp"

namespace splinefeed::hal::modbus {

class PvtStop {
public:
    /// How a feed hold was executed.
    enum class Hold : std::uint8_t {
        none,    ///< not executed
        at_rest, ///< the drive stood; a pending start was cancelled
        in_time, ///< it slowed down from full rate, at the common instant
        apart,   ///< it slowed down, perhaps later than the others, or earlier because its ring ended
    };

    /// For so long a drive that stands by its own word is asked for its positions, too.
    static constexpr std::uint64_t own_word_us = 250'000;

    /// @param axes  of the drive, for the windows in which their shafts stand
    PvtStop(PvtClient& client, std::span<const PvtAxis> axes) noexcept;

    /// What was requested before is over.
    void reset() noexcept {
        pending_ = executed_ = StopRequest::none;
        command_ = PvtCommand::none;
        hold_ = Hold::none;
    }
    /// Takes the drive's last report. @pre not older than the previous one
    void update(const DriveReport& report, const PortTimes& times) noexcept;
    /// Sends a request once, in place of a pending command; sends it again after a refusal.
    /// @param hold_at_us  when all drives begin to slow down, host clock [us]
    void send_once(StopRequest request, std::uint64_t hold_at_us) noexcept;
    [[nodiscard]] StopFacts facts() const noexcept;
    [[nodiscard]] Hold hold() const noexcept { return hold_; }

private:
    [[nodiscard]] PvtCommand command_for(StopRequest request) const noexcept;
    [[nodiscard]] Hold hold_by(const DriveReport& answer, const PortTimes& times) const noexcept;
    [[nodiscard]] bool powerless() const noexcept;
    void forget_positions() noexcept;
    void watch_speed() noexcept;
    /// Whether no axis has moved for this long.
    [[nodiscard]] bool still(std::uint64_t least_us) const noexcept;

    PvtClient* client_;
    DriveReport report_;
    PerAxis<Standstill> standstill_{};
    PerAxis<std::int64_t> window_{};
    std::uint64_t state_since_us_ = 0; // when it reported its state first
    PvtStatus looked_{};               // at the end of the last look at its speed
    std::uint64_t looked_us_ = 0;
    std::int64_t way_counts_ = 0;             // within that look
    bool slows_ = false;                      // the way before was longer
    StopRequest pending_ = StopRequest::none; // sent and not answered yet
    PvtCommand command_ = PvtCommand::none;
    PvtState state_then_ = PvtState::disabled;
    std::uint64_t hold_at_us_ = 0;
    StopRequest executed_ = StopRequest::none;
    std::uint64_t executed_us_ = 0;
    Hold hold_ = Hold::none;
};

} // namespace splinefeed::hal::modbus
