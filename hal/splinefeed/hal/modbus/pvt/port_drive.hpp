// SPDX-License-Identifier: MIT
// PortDrive: one drive of a ModbusPort: its machine axes, its last report, and the commands sent to it.
#pragma once

#include "splinefeed/hal/modbus/pvt/clock_drift_compensation.hpp"
#include "splinefeed/hal/modbus/pvt/port_times.hpp"
#include "splinefeed/hal/modbus/pvt/pvt_client.hpp"

#include <algorithm>
#include <utility>

namespace splinefeed::hal::modbus {

/// Address and configuration of a drive, and the machine axes that it moves.
struct DriveWiring {
    LinkAddress link;
    std::vector<PvtAxis> axes; ///< machine axis of each drive axis
    LinkTiming timing{};
    std::optional<std::uint16_t> watchdog_ms = 1000; ///< empty: the drive keeps its setting
    std::optional<std::uint32_t> following_window{}; ///< [counts]; 0: no check; empty: the drive keeps its setting
    bool both_in_one = true;                         ///< it supports function 23
    std::vector<std::string> axis_names{};           ///< for PortFailure

    /// @param machine_axes  by bits
    [[nodiscard]] bool moves_one_of(std::uint32_t machine_axes) const noexcept {
        return machine_axes == UINT32_MAX || std::any_of(axes.begin(), axes.end(), [&](const PvtAxis& axis) {
                   return axis.machine_axis >= 0 &&
                          (machine_axes >> static_cast<unsigned>(axis.machine_axis) & 1U) != 0;
               });
    }
};

class PortDrive {
public:
    PortDrive(DriveWiring wiring, PvtClient& client) : wiring_(std::move(wiring)), client_(&client) {}

    /// stand_at(), and writes the configuration. @pre the bus is not started
    [[nodiscard]] DriveProblem prepare(const FeedSegment& first, std::uint16_t stop_reserve_ms) noexcept;
    /// Takes first.start as the present position of the axes. Returns false if it does not fit the registers.
    [[nodiscard]] bool stand_at(const FeedSegment& first) noexcept;
    /// Whether the segment fits the drive's registers.
    [[nodiscard]] bool carries(const FeedSegment& segment) const noexcept;
    /// Returns false, and sends nothing of it, if it does not fit the registers or there is no room.
    [[nodiscard]] bool push(const FeedSegment& segment) noexcept;

    /// Updates last_report() and the lag from it.
    void update(std::uint64_t now_us, const PortTimes& times) noexcept;
    [[nodiscard]] const DriveReport& last_report() const noexcept { return report_; }
    [[nodiscard]] const PvtStatus& status() const noexcept { return report_.status; }
    /// Age of the last report. [us]
    [[nodiscard]] std::uint64_t age_us() const noexcept { return age_us_; }
    [[nodiscard]] bool online(const PortTimes& times) const noexcept { return age_us_ < times.silent_us; }
    /// What is wrong with it for good; `none`: nothing.
    [[nodiscard]] DriveProblem lasting_problem(const PortTimes& times) const noexcept;
    /// Why it cannot be started now; `none`: it can.
    [[nodiscard]] DriveProblem unready(const PortTimes& times) const noexcept;
    /// Whether it stands where its next segment starts.
    [[nodiscard]] bool at_joint() const noexcept;
    /// Whether its client's report says that it moves.
    [[nodiscard]] bool moves() const noexcept;
    /// Whether it reports standstill.
    [[nodiscard]] bool at_standstill() const noexcept;
    /// The same; for a drive that is offline or whose report is not valid, whether its segments and its stop must have
    /// ended by now.
    [[nodiscard]] bool presumed_at_standstill(const PortTimes& times) const noexcept;
    /// Whether it has executed all pushed segments.
    [[nodiscard]] bool executed_all() const noexcept { return status().executed == client_->pushed(); }
    [[nodiscard]] bool has_all() const noexcept { return status().next == client_->pushed(); }
    /// Remaining motion in its ring, estimated from the last report. [us]
    [[nodiscard]] double left_us(const PortTimes& times) const noexcept;

    /// Lower bound of its delay behind the motion since start(), for example because it slowed down by itself. [us]
    [[nodiscard]] double lag_us() const noexcept { return lag_us_; }
    /// Whether it started together with the others, from the same position, as far as is known.
    [[nodiscard]] bool in_step() const noexcept { return from_joint_ && !starting_ && lag_us_ <= lag_limit_us; }
    static constexpr double lag_limit_us = 300.0; ///< a drive with a larger lag is not synchronous

    /// Largest uncertainty of its clock at any start. [us]
    [[nodiscard]] double clock_uncertainty_us() const noexcept { return max_clock_uncertainty_us_; }

    /// Sends a command if none is pending and none was sent since clear_sent().
    void send_once(PvtCommand command, std::uint32_t argument) noexcept;
    /// Allows send_once() to send again; discards the last result.
    void clear_sent() noexcept { sent_ = false; }
    /// Sends a command of the set-up, for example `preset_position` with the position of prepare(). @pre none is
    /// pending
    void command(PvtCommand command, std::uint32_t argument) noexcept { client_->command(command, argument, last_); }
    [[nodiscard]] bool pending() const noexcept { return report_.command_pending; }
    /// Whether the command of send_once() was refused.
    [[nodiscard]] bool refused() const noexcept { return sent_ && report_.command_refused; }
    /// Whether it refused the last start.
    [[nodiscard]] bool refuses_start() const noexcept { return start_refused_; }
    /// Starts or resumes it at an instant of the host clock. [us]
    void start(std::uint64_t at_us, const PortTimes& times) noexcept;
    /// Whether a command that is sent now may arrive about its start: too late to cancel that, or it is not known yet
    /// whether it moves.
    [[nodiscard]] bool starts_about(std::uint64_t now_us) const noexcept;
    /// Makes it stop at the end of that segment; if that is too near, as soon as possible.
    void end_at(std::uint32_t sequence, std::uint64_t now_us, const PortTimes& times) noexcept;

    [[nodiscard]] const DriveWiring& wiring() const noexcept { return wiring_; }
    [[nodiscard]] PvtClient& client() noexcept { return *client_; }
    [[nodiscard]] const PvtClient& client() const noexcept { return *client_; }

private:
    [[nodiscard]] double gain_us(double host_us) const noexcept;

    DriveWiring wiring_;
    PvtClient* client_;
    PvtSegment last_;
    PerAxis<std::int64_t> preset_{}; // where its first segment begins [1/65536 count]
    ClockDriftCompensation trim_;
    DriveReport report_;
    std::uint64_t age_us_ = 0;
    double start_us_ = 0.0;                 // requested start, host clock
    double full_rate_us_ = 0.0;             // runs at full rate from then on, host clock
    double began_us_ = 0.0;                 // equivalent start at full rate, host clock
    std::uint64_t ran_ = 0;                 // segments executed since the start
    std::uint32_t ran_to_ = 0;              // sequence number of the next one
    double clock_uncertainty_us_ = 0.0;     // at the last start
    double max_clock_uncertainty_us_ = 0.0; // maximum over all starts
    double lag_us_ = 0.0;
    double gained_us_ = 0.0; // its clock minus host clock, at the anchor
    bool sent_ = false;
    bool start_refused_ = false;
    bool starting_ = false;  // its start is not confirmed yet
    bool from_joint_ = true; // it was started from a joint
};

} // namespace splinefeed::hal::modbus
