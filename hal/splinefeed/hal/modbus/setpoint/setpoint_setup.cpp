// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/setpoint/setpoint_setup.hpp"

#include "splinefeed/hal/modbus/setpoint/setpoint_watch.hpp"
#include "splinefeed/hal/rt/wait_until.hpp"

#include <algorithm>

namespace splinefeed::hal::modbus {

namespace {

constexpr std::uint64_t state_us = 1'000'000; // for a drive to take another state: a brake that opens, too
constexpr std::uint64_t poll_us = 20'000;
constexpr std::uint64_t homing_begins_us = 200'000;
constexpr std::uint64_t homing_us = 300'000'000;
constexpr std::int64_t whole = std::int64_t{1} << physical_bits;

} // namespace

bool SetpointSetup::others_fine() {
    if (trouble_.empty() && options_.interrupted != nullptr && options_.interrupted()) {
        trouble_ = homing_ ? "interrupted during homing" : "interrupted while the drives were made ready";
    }
    if (trouble_.empty() && options_.meanwhile) {
        trouble_ = options_.meanwhile();
    }
    return trouble_.empty();
}

template <class Condition>
std::string SetpointSetup::await(const Condition& condition, std::uint64_t bound_us, const char* sentence) {
    const char* const late = wait_until(
        drive_->link().clock(), [&] { return !others_fine() || condition(); }, bound_us, sentence,
        std::min(poll_us, bound_us));
    return !trouble_.empty() ? trouble_ : late != nullptr ? late : "";
}

bool SetpointSetup::read() {
    return drive_->retry([this] { return drive_->read_status(); });
}

bool SetpointSetup::command(DriveCommand command) {
    return drive_->command(command, drive_->profile().link.retries, [this](std::uint64_t until_us) {
        Clock& clock = drive_->link().clock();
        const std::uint64_t now_us = clock.now_us();
        static_cast<void>(now_us < until_us ? await([&] { return clock.now_us() >= until_us; }, until_us - now_us, "")
                                            : std::string());
        return trouble_.empty();
    });
}

std::string SetpointSetup::failed(const char* what) const {
    return trouble_.empty() ? drive_->trouble(what) : trouble_;
}

std::string SetpointSetup::set_mode(const std::optional<std::int64_t>& mode) {
    return mode && !drive_->write_role(FieldRole::mode, *mode * whole) ? failed("its mode cannot be set") : "";
}

std::string SetpointSetup::write_settings() {
    const DriveProfile& profile = drive_->profile();
    if (!drive_->write_initial()) {
        return failed("its settings cannot be written");
    }
    if (std::string what = set_mode(profile.stream_mode); !what.empty()) {
        return what;
    }
    if (profile.watchdog_timeout_ms > 0 &&
        !drive_->write_role(FieldRole::watchdog, profile.watchdog_timeout_ms * whole)) {
        return failed("its watchdog cannot be set");
    }
    if (profile.following_error_window_counts &&
        !drive_->write_role(FieldRole::following_error_window, *profile.following_error_window_counts * whole)) {
        return failed("its following-error window cannot be set");
    }
    return {};
}

// Out of a fault only if the user wants it. A drive that an earlier run has stopped is switched off first: `resume`
// would go on with its old move.
std::string SetpointSetup::leave_old_state() {
    if (!read()) {
        return failed("its status cannot be read");
    }
    if (drive_->reading().state == DriveState::fault) {
        if (!options_.reset) {
            needs_reset_ = true;
            return fault_sentence(drive_->reading());
        }
        if (!command(DriveCommand::fault_reset)) {
            return failed("its fault cannot be reset");
        }
        return await([&] { return drive_->read_status() && drive_->reading().state != DriveState::fault; }, state_us,
                     "its fault stays after a reset; remove its cause, or switch the drive off and on");
    }
    const auto stopped = [&] {
        return drive_->reading().state == DriveState::quick_stop || drive_->reading().state == DriveState::halted;
    };
    for (const DriveCommand way : {DriveCommand::disable, DriveCommand::fault_reset}) {
        if (stopped() && !drive_->profile().steps_of(way).empty()) {
            if (!command(way)) {
                return failed("its stop cannot be ended");
            }
            if (std::string what = await([&] { return drive_->read_status() && !stopped(); }, state_us, "");
                !trouble_.empty()) {
                return what;
            }
        }
    }
    return stopped() ? "it stays in the stop of an earlier run; switch it off and on" : "";
}

std::string SetpointSetup::enable() {
    if (std::string what = write_settings(); !what.empty()) {
        return what;
    }
    if (std::string what = leave_old_state(); !what.empty()) {
        return what;
    }
    if (!command(DriveCommand::enable)) {
        return failed("it cannot be enabled");
    }
    std::string what = await([&] { return drive_->read_status() && drive_->reading().state == DriveState::enabled; },
                             state_us, "it does not report that it is enabled");
    const bool tripped = !what.empty() && trouble_.empty() && drive_->reading().state == DriveState::fault;
    return tripped ? fault_sentence(drive_->reading()) : what;
}

std::string SetpointSetup::begin() {
    std::string what = options_.home ? home() : std::string();
    if (!what.empty()) {
        return what;
    }
    if (!read()) {
        return failed("its status cannot be read");
    }
    return drive_->prime() ? std::string() : failed("its setpoint cannot be written");
}

std::string SetpointSetup::home() {
    const DriveProfile& profile = drive_->profile();
    if (std::string what = set_mode(profile.homing_mode); !what.empty()) {
        return what;
    }
    homing_ = true; // before the command: its answer may be lost
    if (!command(DriveCommand::home)) {
        return failed("it cannot be homed");
    }
    Clock& clock = drive_->link().clock();
    const std::uint64_t begun_us = clock.now_us();
    const DriveReading& reading = drive_->reading();
    bool homed = false;
    bool lost = false;
    std::string what = await(
        [&] {
            if (!read()) {
                lost = clock.now_us() > drive_->answered_us() + options_.away_us;
                return lost;
            }
            const bool stands = reading.state == DriveState::enabled && (profile.homed ? reading.homed : reading.done);
            homed = stands && clock.now_us() > begun_us + homing_begins_us; // before: maybe not begun
            return homed || reading.state == DriveState::fault || reading.state == DriveState::disabled;
        },
        homing_us, "its homing was not completed; check its switches and its settings");
    if (!what.empty()) {
        return what;
    }
    if (!homed) {
        return lost                                 ? silence(drive_->last_answer(), &drive_->link())
               : reading.state == DriveState::fault ? fault_sentence(reading)
                                                    : "it was disabled during its homing; check its inputs";
    }
    homing_ = false;
    return set_mode(profile.stream_mode);
}

} // namespace splinefeed::hal::modbus
