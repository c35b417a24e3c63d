// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/pvt/pvt_setup.hpp"

#include "splinefeed/hal/rt/wait_until.hpp"

#include <algorithm>

namespace splinefeed::hal::modbus {

namespace {

bool ready_at_standstill(const PortDrive& drive) noexcept {
    const PvtState state = drive.status().state;
    return (state == PvtState::standing || state == PvtState::held) && !drive.pending();
}

} // namespace

bool PvtSetup::carried_out(const std::vector<PortDrive>& drives) noexcept {
    return std::none_of(drives.begin(), drives.end(), [](const PortDrive& drive) { return drive.pending(); });
}

void PvtSetup::update() noexcept {
    const std::uint64_t now_us = clock_.now_us();
    for (PortDrive& drive : drives_) {
        drive.update(now_us, times_);
    }
}

/// The first drive with a problem by this function of a drive.
template <class Problem>
std::optional<DriveFailure> PvtSetup::first_with(const Problem& problem) const {
    for (std::size_t i = 0; i < drives_.size(); ++i) {
        if (const DriveProblem found = problem(drives_[i]); found != DriveProblem::none) {
            return DriveFailure{i, found};
        }
    }
    return std::nullopt;
}

/// Returns whether it was done within the bound. What is wrong then depends on the drive: the caller says it.
template <class Done>
bool PvtSetup::await(std::uint64_t bound_us, const Done& done) {
    const auto looks = [&] {
        update();
        return done();
    };
    return wait_until(clock_, looks, bound_us, "") == nullptr;
}

std::optional<DriveFailure> PvtSetup::command(PvtCommand command, std::uint32_t argument, bool (*interrupted)(),
                                              std::uint32_t axes) {
    for (PortDrive& drive : drives_) {
        if (drive.wiring().moves_one_of(axes)) {
            drive.command(command, argument);
        }
    }
    bool given_up = false;
    static_cast<void>(await(command_us, [&] {
        given_up = interrupted != nullptr && interrupted();
        return given_up || carried_out(drives_);
    }));
    return first_with([&](const PortDrive& drive) {
        const DriveReport& report = drive.last_report();
        return report.problem != DriveProblem::none ? report.problem
               : report.command_refused             ? DriveProblem::refused
               : !report.command_pending            ? DriveProblem::none
               : given_up                           ? DriveProblem::interrupted
               : drive.online(times_)               ? DriveProblem::ignores
                                                    : DriveProblem::silent;
    });
}

// One look: sends what a drive needs next. Returns a problem that waiting does not cure.
std::optional<DriveFailure> PvtSetup::look_at_enabling(bool reset) {
    for (std::size_t i = 0; i < drives_.size(); ++i) {
        PortDrive& drive = drives_[i];
        const DriveProblem problem = drive.last_report().problem;
        Reset& done = resets_[i];
        done = done == Reset::sent && problem == DriveProblem::none ? Reset::executed : done;
        const bool resets = reset && problem == DriveProblem::fault && done != Reset::executed;
        if (problem != DriveProblem::none && !resets) {
            return DriveFailure{i, problem};
        }
        drive.clear_sent();
        if (resets) {
            drive.send_once(PvtCommand::fault_reset, 0); // refused while it moves, and sent again
            done = Reset::sent;
        } else if (drive.status().state == PvtState::disabled) {
            drive.send_once(PvtCommand::enable, 0);
        }
    }
    return std::nullopt;
}

std::optional<DriveFailure> PvtSetup::enable(bool reset) {
    std::optional<DriveFailure> failure;
    const bool done = await(times_.away_us, [&] {
        failure = look_at_enabling(reset);
        return failure || std::all_of(drives_.begin(), drives_.end(), ready_at_standstill);
    });
    if (failure || done) {
        return failure;
    }
    return first_with([this](const PortDrive& drive) {
        return ready_at_standstill(drive)                   ? DriveProblem::none
               : !drive.online(times_)                      ? DriveProblem::silent
               : drive.status().state == PvtState::fault    ? DriveProblem::fault
               : drive.status().state != PvtState::disabled ? DriveProblem::not_standing
               : drive.last_report().command_pending        ? DriveProblem::ignores
                                                            : DriveProblem::refused;
    });
}

std::optional<DriveFailure> PvtSetup::home(std::uint32_t axes, bool (*interrupted)()) {
    if (const auto failure = command(PvtCommand::home, 0, interrupted, axes)) {
        return failure;
    }
    const auto homing = [](const PortDrive& drive) {
        return drive.status().state == PvtState::homing;
    };
    std::optional<DriveFailure> failure;
    const bool done = await(homing_us, [&] {
        const bool given_up = interrupted != nullptr && interrupted();
        failure = first_with([&](const PortDrive& drive) {
            const DriveProblem problem = drive.last_report().problem;
            return problem != DriveProblem::none                 ? problem
                   : homing(drive) && drive.age_us() > silent_us ? DriveProblem::silent
                   : homing(drive) && given_up                   ? DriveProblem::interrupted
                                                                 : DriveProblem::none;
        });
        return failure || std::none_of(drives_.begin(), drives_.end(), homing);
    });
    if (failure || done) {
        return failure;
    }
    return first_with(
        [&](const PortDrive& drive) { return homing(drive) ? DriveProblem::not_homed : DriveProblem::none; });
}

} // namespace splinefeed::hal::modbus
