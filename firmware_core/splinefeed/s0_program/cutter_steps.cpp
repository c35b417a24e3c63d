// SPDX-License-Identifier: MIT
// BlockInterpreter: the items that cutter compensation holds back, changes and adds.
#include "splinefeed/s0_program/block_interpreter.hpp"

namespace splinefeed {

namespace {

constexpr std::int64_t least_tool_arc = 2; // 1e-9 degrees: a shorter one is a line

} // namespace

void BlockInterpreter::set_tool(AxisPoint& point, PlanePoint to) const noexcept {
    const std::array<unsigned, 3> axes = plane_axes(cutter_.offset().plane);
    point[axes[0]] = to.first + cutter_.offset().tip.first;
    point[axes[1]] = to.second + cutter_.offset().tip.second;
}

void BlockInterpreter::fill_tool_arc(ProgramStep& out, PlanePoint centre, Decimal sweep_deg) noexcept {
    if (detail::magnitude(sweep_deg.raw) < static_cast<std::uint64_t>(least_tool_arc)) {
        return;
    }
    AxisPoint at = out.from; // the centre is on the level of the start
    set_tool(at, centre);
    tool_arc_ = {space(at), cutter_.offset().plane, sweep_deg};
    out.shape = MoveShape::arc;
    out.arc = &tool_arc_;
}

// On an arc around a corner; a rapid cuts it, as in LinuxCNC.
void BlockInterpreter::fill_corner(ProgramStep& out) noexcept {
    AxisPoint to = emitted_;
    set_tool(to, cutter_.corner_end());
    fill_move(out, to);
    if (plan_.move == MoveKind::feed) {
        const PlanePoint centre = cutter_.corner();
        const std::array<unsigned, 3> axes = plane_axes(cutter_.offset().plane);
        const PlanePoint tip = cutter_.offset().tip;
        const Decimal begin =
            angle_of(out.from[axes[0]] - tip.first - centre.first, out.from[axes[1]] - tip.second - centre.second);
        const Decimal end =
            angle_of(cutter_.corner_end().first - centre.first, cutter_.corner_end().second - centre.second);
        const int turn = -cutter_.offset().side;
        std::int64_t sweep = turn * (end - begin).raw;
        sweep += sweep < 0 ? Decimal::full_turn : 0;
        fill_tool_arc(out, centre, {turn * sweep});
    }
}

void BlockInterpreter::give_held(ProgramStep& out, ProgramEvent& event) noexcept {
    const bool is_element = cutter_.gives_element();
    const CutterPath::Item& item = cutter_.give();
    manner_ = &item.manner;
    item_line_ = item.line;
    out.kind = item.kind;
    out.stops_before = item.stops_before;
    out.dwell_s = item.dwell_s;
    event = item.event;
    if (item.kind != ItemKind::move) {
        return;
    }
    const ContourElement& element = cutter_.given_element();
    out.move = item.move;
    out.from = emitted_;
    out.to = item.to;
    set_tool(out.to, element.to);
    emitted_ = out.to;
    if (is_element && element.is_arc) {
        fill_tool_arc(out, element.centre, element.tool_sweep_deg());
    }
}

// Whether the item waits for the next move of the contour. Messages do not: their text is gone by then.
bool BlockInterpreter::hold_back(const ProgramStep& step, const ProgramEvent& event) noexcept {
    const bool is_event = step.kind == ItemKind::event;
    if (!step.is_contour && (!cutter_.holds() || (is_event && !event.text.empty()))) {
        return false;
    }
    CutterPath::Item item;
    item.kind = step.kind;
    item.move = step.move;
    item.stops_before = step.stops_before;
    item.line = line_;
    item.manner = plan_.manner;
    item.to = step.to;
    item.dwell_s = step.dwell_s;
    item.event = is_event ? event : ProgramEvent{};
    cutter_.hold(item);
    if (step.kind == ItemKind::move) {
        emitted_ = step.from;
    }
    return true;
}

} // namespace splinefeed
