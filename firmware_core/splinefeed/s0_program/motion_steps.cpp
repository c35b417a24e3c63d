// SPDX-License-Identifier: MIT
// BlockInterpreter: the moves of an executed block, and what canned cycles do between theirs.
#include "splinefeed/s0_program/block_interpreter.hpp"

namespace splinefeed {

void BlockInterpreter::fill_move(ProgramStep& out, const AxisPoint& to) noexcept {
    out.kind = ItemKind::move;
    out.move = plan_.move;
    out.shape = MoveShape::line;
    out.probe = plan_.probe;
    out.home_axes = plan_.home_axes;
    out.stops_before = plan_.stops_before && sub_step_ == 0;
    out.stop_at_end = plan_.stop_at_end;
    out.from = emitted_;
    out.to = to;
    emitted_ = to;
    ++sub_step_;
}

bool BlockInterpreter::next_motion(ProgramStep& out, ProgramEvent& event) noexcept {
    switch (plan_.kind) {
    case PlanKind::none: return false;
    case PlanKind::line_by_way:
        if (sub_step_ == 0) {
            fill_move(out, plan_.way);
        } else {
            fill_move(out, plan_.to);
            plan_.kind = PlanKind::none;
        }
        return true;
    case PlanKind::line:
    case PlanKind::arc:
        if (plan_.is_contour && cutter_.goes_around() && sub_step_ == 0) {
            fill_corner(out);
            return true;
        }
        fill_move(out, plan_.to);
        out.is_contour = plan_.is_contour;
        out.shape = plan_.kind == PlanKind::arc ? MoveShape::arc : MoveShape::line;
        out.arc = &plan_.arc;
        plan_.kind = PlanKind::none;
        return true;
    case PlanKind::point:
        fill_move(out, plan_.to);
        out.is_point = true;
        plan_.kind = PlanKind::none;
        return true;
    case PlanKind::bezier:
        fill_move(out, plan_.to);
        out.shape = MoveShape::bezier;
        out.bezier = std::get_if<BezierPlan>(&series_);
        plan_.kind = PlanKind::none;
        return true;
    case PlanKind::nurbs: {
        BezierPlan* const piece = std::get_if<BezierPlan>(&series_); // plan_nurbs() has put it there
        if (piece == nullptr || !nurbs_.next(*piece)) {
            return false;
        }
        out.bezier = piece;
        AxisPoint to = emitted_;
        for (unsigned k = 0; k < 2; ++k) {
            to[letters_.place("xy"[k])] = piece->points[static_cast<unsigned>(piece->degree)][k];
        }
        fill_move(out, to);
        out.shape = MoveShape::bezier;
        return true;
    }
    case PlanKind::tap: return next_of_tap(out, event);
    case PlanKind::thread: return next_of_thread(out);
    case PlanKind::cycle: break;
    }
    return next_in_cycle(out, event);
}

void BlockInterpreter::turn_spindle(CycleStep how, Decimal speed, ProgramStep& out,
                                    ProgramEvent& event) const noexcept {
    const bool clockwise = (modal_.spindle == SpindleState::clockwise) == (how != CycleStep::spindle_reverse);
    out.kind = ItemKind::event;
    out.stops_before = true;
    event = {};
    event.stops = true;
    event.value = speed;
    event.kind = how == CycleStep::spindle_stop ? EventKind::spindle_stop
                 : clockwise                    ? EventKind::spindle_clockwise
                                                : EventKind::spindle_counterclockwise;
}

bool BlockInterpreter::next_in_cycle(ProgramStep& out, ProgramEvent& event) noexcept {
    AxisPoint at{};
    CannedCycle* cycle = std::get_if<CannedCycle>(&series_);
    const CycleStep step = cycle != nullptr ? cycle->next(at) : CycleStep::finished;
    switch (step) {
    case CycleStep::lift:
        plan_.move = MoveKind::rapid;
        fill_move(out, frame_.to_machine(at));
        return true;
    case CycleStep::rapid:
    case CycleStep::feed:
        plan_.move = step == CycleStep::rapid ? MoveKind::rapid
                     : taps(modal_.motion)    ? MoveKind::turning
                                              : MoveKind::feed;
        plan_.manner.mode = PathMode::exact_path;
        plan_.manner.tolerance_mm = {};
        fill_move(out, frame_.to_machine(at));
        return true;
    case CycleStep::dwell:
        out.kind = ItemKind::dwell;
        out.stops_before = true;
        out.dwell_s = cycle->dwell_s();
        return true;
    case CycleStep::spindle_stop:
    case CycleStep::spindle_start:
    case CycleStep::spindle_reverse: turn_spindle(step, modal_.speed, out, event); return true;
    case CycleStep::finished: break;
    }
    plan_.kind = PlanKind::none;
    return false;
}

} // namespace splinefeed
