// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/program_spindle.hpp"

#include <fmt/format.h>

namespace splinefeed::host {

bool ProgramSpindle::is_of(EventKind kind) noexcept {
    return kind == EventKind::spindle_speed || kind == EventKind::spindle_clockwise ||
           kind == EventKind::spindle_counterclockwise || kind == EventKind::spindle_stop ||
           kind == EventKind::surface_speed;
}

std::string ProgramSpindle::take(EventKind kind, double rpm, const SpindleDescription& machine) {
    turn_.reset();
    change_s_ = 0.0;
    int direction = kind == EventKind::spindle_clockwise ? 1 : kind == EventKind::spindle_counterclockwise ? -1 : 0;
    const bool follows = kind == EventKind::surface_speed;
    if (kind == EventKind::spindle_speed || follows) {
        direction = direction_;
        if (direction == 0) {
            return {};
        }
    }
    if (direction != 0 && rpm != 0.0 && !(rpm >= machine.min_rpm && rpm <= machine.max_rpm)) {
        return fmt::format("the spindle would turn with S{:g}; S must be {}at most {:g}, as [spindle] of the machine "
                           "file has it, or 0 to stand",
                           rpm, machine.min_rpm > 0.0 ? fmt::format("at least {:g} and ", machine.min_rpm) : "",
                           machine.max_rpm);
    }
    if (direction < 0 && !machine.reverses()) {
        return machine.vfd
                   ? fmt::format("M4: the profile {} has no command to reverse; use M3", machine.vfd->profile.name)
                   : "M4: the spindle has no line to reverse; name it in [spindle.reverse], or use M3";
    }
    direction_ = direction;
    const double wanted = direction * rpm;
    change_s_ = follows ? 0.0 : machine.change_s(signed_rpm_, wanted);
    signed_rpm_ = wanted;
    if (follows) {
        return {};
    }
    turn_ = wanted == 0.0 ? SpindleTurn{} : SpindleTurn{direction, rpm};
    return {};
}

} // namespace splinefeed::host
