// SPDX-License-Identifier: MIT
// SpindleDescription: the spindle of a machine: its speeds, and the frequency inverter (VFD) or the lines that turn it.
#pragma once

#include "host_sim/config/drive_address.hpp"
#include "host_sim/config/program_pins.hpp"

#include "splinefeed/hal/modbus/profile/drive_profile.hpp"

#include <optional>

namespace splinefeed::host {

struct SpindleDescription {
    struct Vfd {
        DriveAddress address; ///< with the values of the profile where it states none
        hal::modbus::DriveProfile profile;
    };

    double min_rpm = 0.0; ///< `run` refuses programs that ask for less, or more than the next
    double max_rpm = 0.0;
    double rpm_per_hz = 60.0;         ///< of the VFD's output: 60 for a motor of two poles, 30 for one of four
    double ramp_s = 0.0;              ///< from standstill to max_rpm, as the simulated machine counts it
    double at_speed_timeout_s = 10.0; ///< a spindle that takes longer ends the run
    std::optional<Vfd> vfd{};
    std::optional<SpindlePins> lines{}; ///< neither vfd nor lines: real targets have no spindle

    [[nodiscard]] bool is_controlled() const noexcept { return vfd || lines; }
    /// How long the simulated machine waits for a change of speed; speeds have the sign of their direction.
    [[nodiscard]] double change_s(double from_rpm, double to_rpm) const noexcept {
        if (lines) {
            const bool turns_round = from_rpm * to_rpm < 0.0;
            return to_rpm == 0.0 || from_rpm * to_rpm > 0.0
                       ? 0.0
                       : lines->spin_up_s + (turns_round ? lines->spin_down_s : 0.0);
        }
        return ramp_s * (to_rpm > from_rpm ? to_rpm - from_rpm : from_rpm - to_rpm) / max_rpm;
    }
    [[nodiscard]] bool reverses() const noexcept {
        return lines ? lines->reverse.has_value()
                     : !vfd || !vfd->profile.steps_of(hal::modbus::DriveCommand::reverse).empty();
    }
};

} // namespace splinefeed::host
