// SPDX-License-Identifier: MIT
#include "host_sim/serve/motion_gate.hpp"

#include <utility>

namespace splinefeed::host {

void MotionGate::advance() {
    if ((!segment_ && home_ == 0) || (state_ != nullptr && !state_->is_kept())) {
        return;
    }
    if (const std::uint32_t axes = std::exchange(home_, 0U); axes != 0) {
        machine_->home(axes);
    }
    if (segment_) {
        machine_->submit(*std::exchange(segment_, std::nullopt));
    }
}

void MotionGate::submit(const FeedSegment& segment) {
    if (!std::exchange(moved_, true) && state_ != nullptr) {
        state_->moves();
        segment_ = segment;
    } else {
        machine_->submit(segment);
    }
}

void MotionGate::home(std::uint32_t axes) noexcept {
    gave_up_ = false;
    home_ = axes;
    if (!std::exchange(moved_, true) && state_ != nullptr) {
        state_->moves();
    }
}

void MotionGate::quick_stop() noexcept {
    segment_.reset();
    gave_up_ = std::exchange(home_, 0U) != 0;
    machine_->quick_stop();
}

MachineReading MotionGate::read() noexcept {
    MachineReading out = machine_->read();
    out.stands = out.stands && !segment_;
    if (home_ != 0 || gave_up_) {
        out.homing = gave_up_ ? HomingPhase::failed : HomingPhase::busy;
    }
    return out;
}

void MotionGate::obey(const ProgramEvent& event) noexcept {
    const bool turns = event.kind == EventKind::spindle_clockwise || event.kind == EventKind::spindle_counterclockwise;
    spindle_turns_ = turns || (spindle_turns_ && event.kind != EventKind::spindle_stop);
    machine_->obey(event);
}

} // namespace splinefeed::host
