// SPDX-License-Identifier: MIT
// CommandSequence: converts a command of a drive profile to a sequence of frames and pauses.
#pragma once

#include "splinefeed/hal/modbus/setpoint/setpoint_frames.hpp"

namespace splinefeed::hal::modbus {

/// Use: begin(command); until finished(): if (due_us() <= now) { write next(); on_sent(now); }.
/// docs/reference/profiles.md describes the frames of each kind of step. A field of the target group is sent with the
/// whole group. If a write is not answered, write it again: next() stays the same until on_sent(). Exception: if a
/// toggle may have arrived, read the drive's state first. Does not allocate.
class CommandSequence {
public:
    /// Both must outlive the sequence. `frames` holds the last value of each field.
    CommandSequence(const DriveProfile& profile, SetpointFrames& frames) noexcept
        : profile_(profile), frames_(frames) {}

    /// Begins a command at its first step and abandons a command in progress, so a quick stop takes precedence. Returns
    /// false if the profile has no such command.
    bool begin(DriveCommand command) noexcept;
    [[nodiscard]] bool finished() const noexcept { return steps_ == nullptr; }
    /// The next frame, and the earliest instant to write it. [us] @pre not finished
    [[nodiscard]] const RegisterWrite& next() const noexcept { return write_; }
    [[nodiscard]] std::uint64_t due_us() const noexcept { return due_us_; }
    /// Reports that next() has arrived at this instant. [us]
    void on_sent(std::uint64_t now_us) noexcept;

private:
    void prepare() noexcept;
    [[nodiscard]] bool two_frames() const noexcept;

    const DriveProfile& profile_;
    SetpointFrames& frames_;
    const std::vector<CommandStep>* steps_ = nullptr; // nullptr: finished
    std::size_t step_ = 0;
    bool second_ = false; // the second frame of an edge or a pulse
    std::uint64_t due_us_ = 0;
    RegisterWrite write_;
};

} // namespace splinefeed::hal::modbus
