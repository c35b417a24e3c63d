// SPDX-License-Identifier: MIT
// BlockInterpreter: what constant surface speed makes of moves and of events of the spindle.
#include "splinefeed/s0_program/block_interpreter.hpp"

namespace splinefeed {

// Whether the move is given in pieces. Without that the item is given as it is.
bool BlockInterpreter::follow_radius(const ProgramStep& step, ProgramEvent& event) noexcept {
    if (step.kind == ItemKind::event &&
        (event.kind == EventKind::spindle_speed || event.kind == EventKind::spindle_clockwise ||
         event.kind == EventKind::spindle_counterclockwise)) {
        if (modal_.surface.applies()) {
            event.value = modal_.surface.at(frame_.to_program(emitted_)[letters_.place('x')]);
        }
        told_speed_ = event.value;
    }
    if (step.kind != ItemKind::move || !manner_->surface.applies()) {
        return false;
    }
    settles_ = settles_ || step.move == MoveKind::rapid;
    if (step.move != MoveKind::feed) {
        return false;
    }
    const bool is_arc = step.shape == MoveShape::arc;
    surface_.begin(step, *manner_, frame_, letters_.place('x'), plane_axes(is_arc ? step.arc->plane : Plane::xy),
                   {letters_.index('x'), letters_.index('y'), letters_.index('z')});
    return true;
}

// A piece, or the speed that it needs. Behind a rapid the machine waits for that, as in LinuxCNC.
void BlockInterpreter::give_piece(ProgramStep& out, ProgramEvent& event) noexcept {
    manner_ = &surface_.manner();
    if (surface_.speed() == told_speed_) {
        settles_ = false;
        surface_.next(frame_, out);
        return;
    }
    told_speed_ = surface_.speed();
    event = {};
    event.kind = settles_ ? EventKind::spindle_speed : EventKind::surface_speed;
    event.stops = settles_;
    event.value = told_speed_;
    out.kind = ItemKind::event;
    out.stops_before = settles_;
}

} // namespace splinefeed
