// SPDX-License-Identifier: MIT
// SetpointSetup: makes one drive ready for a motion: settings, a way out of old states, enabling, homing.
#pragma once

#include "splinefeed/hal/modbus/setpoint/setpoint_drive.hpp"

namespace splinefeed::hal::modbus {

struct SetupOptions {
    bool home = false;                 ///< home the drive first
    bool reset = false;                ///< reset a fault that the drive has
    std::uint32_t away_us = 5'000'000; ///< a homing drive without an answer for this long is lost
    bool (*interrupted)() = nullptr;   ///< polled in every wait; true: the set-up ends
    /// Called in every wait, to poll other drives and feed their watchdogs. A result that is not empty is a failure and
    /// ends the set-up.
    std::function<std::string()> meanwhile{};
};

/// For one thread; use one object for each step. Its functions block, allocate, and return what is wrong; empty:
/// nothing. They do not stop the drive: the caller does, by StopSequence. @pre the drive is open and configured
class SetpointSetup {
public:
    SetpointSetup(SetpointDrive& drive, SetupOptions options) : drive_(&drive), options_(std::move(options)) {}

    /// Writes the init list, mode, watchdog and window, leaves the states of an earlier run, and enables the drive.
    /// Takes a few seconds at most.
    [[nodiscard]] std::string enable();
    /// After enable(): homes the drive, if set, and sends its present position as the first target.
    [[nodiscard]] std::string begin();
    /// Whether the drive may move by itself, towards its reference.
    [[nodiscard]] bool homing() const noexcept { return homing_; }
    /// Whether enable() failed only because the drive is in a fault, which the options do not reset.
    [[nodiscard]] bool needs_reset() const noexcept { return needs_reset_; }

private:
    [[nodiscard]] bool others_fine();
    template <class Condition>
    [[nodiscard]] std::string await(const Condition& condition, std::uint64_t bound_us, const char* sentence);
    [[nodiscard]] bool read();
    [[nodiscard]] bool command(DriveCommand command);
    [[nodiscard]] std::string failed(const char* what) const;
    [[nodiscard]] std::string set_mode(const std::optional<std::int64_t>& mode);
    [[nodiscard]] std::string write_settings();
    [[nodiscard]] std::string leave_old_state();
    [[nodiscard]] std::string home();

    SetpointDrive* drive_;
    SetupOptions options_;
    std::string trouble_; // of another drive, or of the user
    bool homing_ = false;
    bool needs_reset_ = false;
};

} // namespace splinefeed::hal::modbus
