// SPDX-License-Identifier: MIT
// CommandSequence: a command of a drive profile as frames and pauses, one after the other.
#pragma once

#include "splinefeed/hal/modbus/setpoint/setpoint_frames.hpp"

#include <optional>

namespace splinefeed::hal::modbus {

/// Use: begin(command); until finished(): if (due() <= now) { write next(); on_sent(now); }
/// The frames of the steps: a level is one, an edge, a pulse and a toggle as docs/reference/profiles.md has them. A
/// field of the target group goes out with the whole group. A write that was not answered is simply written again:
/// next() stays the same until on_sent(). But a toggle: whoever does not know whether it arrived must look. It does not
/// allocate.
class CommandSequence {
public:
    /// Both must outlive it; the frames hold what each field was told last.
    CommandSequence(const DriveProfile& profile, SetpointFrames& frames) noexcept
        : profile_(profile), frames_(frames) {}

    /// From its first step, whatever was under way: a quick stop goes ahead of everything. False: the profile has no
    /// such command.
    bool begin(DriveCommand command) noexcept;
    [[nodiscard]] bool finished() const noexcept { return steps_ == nullptr; }
    /// The frame to be written, and not before this instant. @pre not finished
    [[nodiscard]] const RegisterWrite& next() const noexcept { return write_; }
    [[nodiscard]] std::uint64_t due_us() const noexcept { return due_us_; }
    /// next() has arrived, at this instant.
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
