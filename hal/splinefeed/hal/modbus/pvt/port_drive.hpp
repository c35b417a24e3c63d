// SPDX-License-Identifier: MIT
// PortDrive: one drive as the port sees it: which of the machine's axes it has, what it said last, and what it was
// told.
#pragma once

#include "splinefeed/hal/modbus/pvt/clock_drift_compensation.hpp"
#include "splinefeed/hal/modbus/pvt/port_times.hpp"
#include "splinefeed/hal/modbus/pvt/pvt_client.hpp"

#include <utility>

namespace splinefeed::hal::modbus {

/// A drive and the machine's axes that it has.
struct DriveWiring {
    LinkAddress link;
    std::vector<PvtAxis> axes; ///< of the drive, in its order
    LinkTiming timing{};
    std::optional<std::uint16_t> watchdog_ms = 1000; ///< without it, and the window, the drive keeps its own
    std::optional<std::uint32_t> following_window{}; ///< [counts]; 0: none
    bool both_in_one = true;                         ///< it has function 23
};

class PortDrive {
public:
    PortDrive(DriveWiring wiring, PvtClient& client) : wiring_(std::move(wiring)), client_(&client) {}

    /// Writes the configuration, and takes `first` for where the axes stand. Before the bus runs.
    [[nodiscard]] DriveProblem prepare(const FeedSegment& first, std::uint16_t stop_reserve_ms) noexcept;
    /// Whether push() takes it.
    [[nodiscard]] bool carries(const FeedSegment& segment) const noexcept;
    /// @param rests  the machine stands at the segment's end
    /// @pre carries(segment)
    void push(const FeedSegment& segment, bool rests) noexcept;

    /// What it said last becomes last_report().
    void update(std::uint64_t now_us, const PortTimes& times) noexcept;
    [[nodiscard]] const DriveReport& last_report() const noexcept { return report_; }
    [[nodiscard]] const PvtStatus& status() const noexcept { return report_.status; }
    /// How old that is. [us]
    [[nodiscard]] std::uint64_t age_us() const noexcept { return age_us_; }
    [[nodiscard]] bool online(const PortTimes& times) const noexcept { return age_us_ < times.silent_us; }
    /// It says that it stands.
    [[nodiscard]] bool at_standstill() const noexcept;
    /// The same, or, where it says nothing that counts, by what it had when it was last heard.
    [[nodiscard]] bool presumed_at_standstill(const PortTimes& times) const noexcept;
    /// Executed everything that was pushed.
    [[nodiscard]] bool executed_all() const noexcept { return status().executed == client_->pushed(); }
    [[nodiscard]] bool has_all() const noexcept { return status().next == client_->pushed(); }
    /// How long its ring lasts by now, as far as is known. [us]
    [[nodiscard]] double left_us(const PortTimes& times) const noexcept;

    /// It is behind the motion by at least so much: it slowed down, all by itself. [us] Of all that it said since
    /// start().
    [[nodiscard]] double lag_us() const noexcept { return lag_us_; }
    /// As far as is known it was started together with the others, from the same place.
    [[nodiscard]] bool in_step() const noexcept { return from_joint_ && !starting_ && lag_us_ <= lag_limit_us; }
    static constexpr double lag_limit_us = 300.0; ///< a drive that is behind by more is out of step

    /// Within what its clock was known when it was started, at the worst. [us]
    [[nodiscard]] double clock_uncertainty_us() const noexcept { return max_clock_uncertainty_us_; }

    /// Gives a command, once until clear_sent() and if none is pending.
    void send_once(PvtCommand command, std::uint32_t argument) noexcept;
    /// The last of them is no longer of interest.
    void clear_sent() noexcept { sent_ = false; }
    /// `place` and what goes before it, on the way to the start.
    void command(PvtCommand command, std::uint32_t argument) noexcept { client_->command(command, argument, last_); }
    [[nodiscard]] bool pending() const noexcept { return report_.command_pending; }
    /// What send_once() told was refused.
    [[nodiscard]] bool refused() const noexcept { return sent_ && report_.command_refused; }
    /// It is to begin, or to go on, at that instant of our clock.
    void start(std::uint64_t at_us, const PortTimes& times) noexcept;
    /// To the end of that segment; where that is too near by now, as soon as it can.
    void end_at(std::uint32_t sequence, std::uint64_t now_us, const PortTimes& times) noexcept;

    [[nodiscard]] const DriveWiring& wiring() const noexcept { return wiring_; }
    [[nodiscard]] PvtClient& client() noexcept { return *client_; }
    [[nodiscard]] const PvtClient& client() const noexcept { return *client_; }

private:
    [[nodiscard]] double gain_us(double host_us) const noexcept;

    DriveWiring wiring_;
    PvtClient* client_;
    PvtSegment last_;
    ClockDriftCompensation trim_;
    DriveReport report_;
    std::uint64_t age_us_ = 0;
    double start_us_ = 0.0;                 // of our clock: it was to begin then
    double full_rate_us_ = 0.0;             // of our clock: it runs at full rate from then on,
    double began_us_ = 0.0;                 // as if it had started then
    std::uint64_t ran_ = 0;                 // segments that it executed since
    std::uint32_t ran_to_ = 0;              // the number of the next one
    double clock_uncertainty_us_ = 0.0;     // of its clock, then
    double max_clock_uncertainty_us_ = 0.0; // of all its starts
    double lag_us_ = 0.0;
    double gained_us_ = 0.0; // its clock less ours, at the anchor
    bool sent_ = false;
    bool starting_ = false;  // its start was not answered yet
    bool from_joint_ = true; // it was started from a joint
};

} // namespace splinefeed::hal::modbus
