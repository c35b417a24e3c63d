// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/pvt/pvt_setup.hpp"

#include <algorithm>

namespace splinefeed::hal::modbus {

namespace {

constexpr std::uint64_t homing_us = 300'000'000;
constexpr std::uint64_t poll_interval_us = 1000;

bool ready_at_standstill(const PortDrive& drive) noexcept {
    const PvtState state = drive.status().state;
    return (state == PvtState::standing || state == PvtState::held) && !drive.pending();
}

} // namespace

bool PvtSetup::carried_out(const std::vector<PortDrive>& drives) noexcept {
    return std::none_of(drives.begin(), drives.end(), [](const PortDrive& drive) { return drive.pending(); });
}

// Waits for one poll interval and reads the drives' reports.
void PvtSetup::poll() noexcept {
    clock_.sleep_us(poll_interval_us);
    now_us_ = clock_.now_us();
    for (PortDrive& drive : drives_) {
        drive.update(now_us_, times_);
    }
}

std::optional<DriveFailure> PvtSetup::command(PvtCommand command, std::uint32_t argument) {
    for (PortDrive& drive : drives_) {
        drive.command(command, argument);
    }
    const std::uint64_t until = clock_.now_us() + command_us;
    do {
        poll();
    } while (!carried_out(drives_) && now_us_ < until);
    for (std::size_t i = 0; i < drives_.size(); ++i) {
        const DriveReport& report = drives_[i].last_report();
        if (report.command_pending || report.command_refused || report.problem != DriveProblem::none) {
            return DriveFailure{i, report.problem != DriveProblem::none ? report.problem
                                   : report.command_refused             ? DriveProblem::refused
                                                                        : DriveProblem::silent};
        }
    }
    return std::nullopt;
}

std::optional<DriveFailure> PvtSetup::enable(std::uint64_t within_us) {
    const std::uint64_t until = clock_.now_us() + within_us;
    for (;;) {
        poll();
        bool ready = true;
        for (std::size_t i = 0; i < drives_.size(); ++i) {
            PortDrive& drive = drives_[i];
            ready = ready && ready_at_standstill(drive);
            if (const DriveProblem problem = drive.last_report().problem; problem != DriveProblem::none) {
                return DriveFailure{i, problem}; // it does not go away
            }
            if (now_us_ > until && !ready_at_standstill(drive)) {
                return DriveFailure{i, drive.refused() ? DriveProblem::refused : DriveProblem::silent};
            }
            drive.clear_sent();
            if (drive.status().state == PvtState::fault) {
                drive.send_once(PvtCommand::fault_reset, 0);
            } else if (drive.status().state == PvtState::disabled) {
                drive.send_once(PvtCommand::enable, 0);
            }
        }
        if (ready) {
            return std::nullopt;
        }
    }
}

std::optional<DriveFailure> PvtSetup::home(bool (*interrupted)()) {
    if (const auto failure = command(PvtCommand::home)) {
        return failure;
    }
    const std::uint64_t until = clock_.now_us() + homing_us;
    for (;;) {
        poll();
        const bool given_up = now_us_ > until || (interrupted != nullptr && interrupted());
        bool homing = false;
        for (std::size_t i = 0; i < drives_.size(); ++i) {
            const bool turns = drives_[i].status().state == PvtState::homing;
            homing = homing || turns;
            const DriveProblem problem = drives_[i].last_report().problem;
            if (problem != DriveProblem::none || (turns && given_up)) {
                return DriveFailure{i, problem == DriveProblem::none ? DriveProblem::not_homed : problem};
            }
        }
        if (!homing) {
            return std::nullopt;
        }
    }
}

} // namespace splinefeed::hal::modbus
