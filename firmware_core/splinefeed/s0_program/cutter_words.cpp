// SPDX-License-Identifier: MIT
// BlockInterpreter: G40, G41, G42, and what cutter compensation makes of moves.
//
// A contour is compensated in machine coordinates, which do not change while it lasts.
#include "splinefeed/s0_program/block_interpreter.hpp"

#include "splinefeed/s0_program/text/decimal_text.hpp"

namespace splinefeed {

namespace {

constexpr Decimal no_way{10}; // 1e-8 mm: what rotations leave of a move across the plane

// The tip of a lathe tool lies towards +x or -x, +z or -z of the middle of its radius, by its orientation.
constexpr std::array<std::array<std::int8_t, 2>, 10> tips{
    {{0, 0}, {1, -1}, {-1, -1}, {-1, 1}, {1, 1}, {1, 0}, {0, -1}, {-1, 0}, {0, 1}, {0, 0}}}; // z, x

PlanePoint plane_point(const AxisPoint& point, const std::array<unsigned, 3>& axes) noexcept {
    return {point[axes[0]], point[axes[1]]};
}

} // namespace

// Of the first, the second and the third axis of a plane.
std::array<unsigned, 3> BlockInterpreter::plane_axes(Plane plane) const noexcept {
    std::array<unsigned, 3> axes{};
    for (unsigned k = 0; k < 3; ++k) {
        axes[k] = static_cast<unsigned>(letters_.index(letters_of(plane).axes[k])); // not used where there is none
    }
    return axes;
}

bool BlockInterpreter::ends_program() const noexcept {
    const std::int16_t code = block_.code(CodeGroup::stop);
    return has_ended() || code == 2 || code == 30;
}

// The diameter by D of G41.1, or of a tool of the table.
BlockStatus BlockInterpreter::find_tool(CutterOffset& out) const noexcept {
    std::int32_t orientation = 0;
    Decimal diameter = modal_.in_mm(block_.value('d'));
    if (const std::int16_t code = block_.code(CodeGroup::cutter_radius); code == 411 || code == 421) {
        if (!block_.has('d')) {
            return block_.at(ProgramError::cutter_diameter_missing, CodeGroup::cutter_radius);
        }
        if (block_.has('l') && !to_integer(block_.value('l'), orientation)) {
            return block_.at(ProgramError::integer_needed, 'l');
        }
    } else {
        const bool is_kept = modal_.cutter_number >= 0;
        std::int32_t number = is_kept ? modal_.cutter_number : frame_.offsets().tool_number;
        if (block_.has('d') && (!to_integer(block_.value('d'), number) || number < 0)) {
            return block_.at(ProgramError::tool_unknown, 'd');
        }
        if (settings_.tools == nullptr) {
            return block_.at(ProgramError::tool_table_missing, CodeGroup::cutter_radius);
        }
        ToolOffset tool;
        if (!settings_.tools->find(number, tool) && (number > 0 || !(block_.has('d') || is_kept))) {
            return block_.has('d') ? block_.at(ProgramError::tool_unknown, 'd')
                                   : block_.at(ProgramError::tool_unknown, CodeGroup::cutter_radius);
        }
        diameter = tool.diameter;
        orientation = tool.orientation;
    }
    const bool is_mill = orientation == 0 || orientation == 9;
    if (orientation < 0 || orientation > 9 || (!is_mill && modal_.plane != Plane::zx) ||
        diameter.raw > largest_position.raw || diameter.raw < -largest_position.raw) {
        return block_.at(ProgramError::cutter_tool_unsuited, CodeGroup::cutter_radius);
    }
    out.side = diameter.raw < 0 ? -out.side : out.side; // as in LinuxCNC
    out.radius.raw = static_cast<std::int64_t>(detail::magnitude(diameter.raw) / 2);
    const std::array<std::int8_t, 2>& tip = tips[static_cast<unsigned>(orientation)];
    out.tip = {{tip[0] * out.radius.raw}, {tip[1] * out.radius.raw}};
    return {};
}

// D of the controls where it stays: the number for the next G41, and not the diameter of G41.1.
BlockStatus BlockInterpreter::keep_cutter_number() noexcept {
    const std::int16_t code = block_.code(CodeGroup::cutter_radius);
    if (!rules().keeps_cutter_number || !block_.has('d') || code == 411 || code == 421) {
        return {};
    }
    if (code == Block::no_code && modal_.cutter.side != 0) {
        return block_.at(ProgramError::cutter_active, 'd');
    }
    constexpr std::int32_t most = 9999;
    std::int32_t number = 0;
    if (!to_integer(block_.value('d'), number) || number < 0 || number > most) {
        return block_.at(ProgramError::tool_unknown, 'd');
    }
    modal_.cutter_number = static_cast<std::int16_t>(number);
    return {};
}

BlockStatus BlockInterpreter::set_cutter() noexcept {
    const std::int16_t code = block_.code(CodeGroup::cutter_radius);
    if (const BlockStatus status = keep_cutter_number(); !status.ok()) {
        return status;
    }
    if (code == 400) {
        modal_.needs_straight = modal_.needs_straight || cutter_.has_entered();
        modal_.cutter = {};
    }
    if (code <= 400) {
        return {};
    }
    const bool has_axes = letters_.index('x') >= 0 && letters_.index(modal_.plane == Plane::xy ? 'y' : 'z') >= 0;
    if (modal_.plane == Plane::yz || !has_axes || (modal_.plane == Plane::zx && frame_.is_turned())) {
        return block_.at(ProgramError::cutter_plane, CodeGroup::cutter_radius);
    }
    if (modal_.cutter.side != 0) {
        return block_.at(ProgramError::cutter_on, CodeGroup::cutter_radius);
    }
    modal_.cutter.plane = modal_.plane;
    modal_.cutter.side = code < 420 ? 1 : -1;
    return find_tool(modal_.cutter);
}

// What changes the machine's coordinates, or does not know where the next move leads, ends a contour first.
BlockStatus BlockInterpreter::check_cutter() const noexcept {
    if (modal_.plane != modal_.cutter.plane) {
        return block_.at(ProgramError::cutter_active, CodeGroup::plane);
    }
    for (const CodeGroup group : {CodeGroup::tool_length, CodeGroup::work_system, CodeGroup::tool_change}) {
        if (block_.has(group)) {
            return block_.at(ProgramError::cutter_active, group);
        }
    }
    if (block_.has(CodeGroup::non_modal) && block_.code(CodeGroup::non_modal) != 40) {
        return block_.at(ProgramError::cutter_active, CodeGroup::non_modal);
    }
    if (block_.code(CodeGroup::input_output) == 66) {
        return block_.at(ProgramError::cutter_active, CodeGroup::input_output);
    }
    const bool is_plain = plan_.kind == PlanKind::none || plan_.kind == PlanKind::line || plan_.kind == PlanKind::arc;
    const bool is_cut = plan_.move == MoveKind::feed || plan_.move == MoveKind::rapid;
    return is_plain && is_cut ? BlockStatus{} : block_.at(ProgramError::cutter_active, CodeGroup::motion);
}

// F of G93 counts the programmed length, as in LinuxCNC: corners and inner arcs are then made with the same feed.
void BlockInterpreter::count_by_length(const ContourElement& element, const AxisPoint& from) noexcept {
    const unsigned normal = plane_axes(modal_.plane)[2];
    Decimal way = plane_distance(element.programmed_from, element.programmed_to);
    if (element.is_arc) {
        const auto angle = static_cast<std::int64_t>(detail::magnitude(radians_q32(element.sweep_deg)));
        way.raw =
            product_quotient(plane_distance(element.centre, element.programmed_to).raw, angle, std::uint64_t{1} << 32)
                .raw;
    }
    way = is_position(way) ? hypotenuse(way, plan_.to[normal] - from[normal]) : way;
    plan_.manner.inverse_time = false;
    plan_.manner.feed.raw =
        product_quotient(way.raw, plan_.manner.feed.raw, static_cast<std::uint64_t>(Decimal::one)).raw;
}

// After the motion of a block has been planned. @param from  where the programmed point was, in machine coordinates
BlockStatus BlockInterpreter::plan_contour(const AxisPoint& from) noexcept {
    const bool moves = plan_.kind != PlanKind::none;
    if (!modal_.cutter.applies()) {
        const bool is_straight = plan_.kind == PlanKind::line || plan_.kind == PlanKind::line_by_way;
        if (moves && modal_.needs_straight && !is_straight) {
            return block_.at(ProgramError::cutter_exit, CodeGroup::motion);
        }
        modal_.needs_straight = modal_.needs_straight && !moves;
        return cutter_.has_entered() ? block_.at(cutter_.plan_end().error(), CodeGroup::cutter_radius) : BlockStatus{};
    }
    if (const BlockStatus status = check_cutter(); !status.ok()) {
        return status;
    }
    const std::array<unsigned, 3> axes = plane_axes(modal_.plane);
    ContourElement element;
    element.is_arc = plan_.kind == PlanKind::arc;
    element.programmed_from = plane_point(from, axes);
    element.programmed_to = plane_point(plan_.to, axes);
    const bool goes_on =
        moves && (element.is_arc || plane_distance(element.programmed_from, element.programmed_to) > no_way);
    if (!goes_on) {
        return check_room();
    }
    if (element.is_arc) {
        const PlaneLetters letters = letters_of(modal_.plane);
        element.centre = {plan_.arc.centre[static_cast<unsigned>(letters.axes[0] - 'x')],
                          plan_.arc.centre[static_cast<unsigned>(letters.axes[1] - 'x')]};
        element.sweep_deg = plan_.arc.sweep_deg;
    }
    if (!cutter_.has_entered()) {
        element.from = plane_point(emitted_, axes);
        element.programmed_from = element.is_arc ? element.programmed_from : element.from;
        if (element.is_arc && (modal_.cutter.tip != PlanePoint{} || modal_.needs_straight)) {
            return block_.at(ProgramError::cutter_exit, CodeGroup::motion);
        }
    }
    if (plan_.move != MoveKind::rapid && plan_.manner.inverse_time) {
        count_by_length(element, from);
    }
    plan_.is_contour = true;
    ProgramStatus status = cutter_.plan_element(element, modal_.cutter);
    status = status.ok() && ends_program() ? cutter_.check_end() : status;
    return status.ok() ? BlockStatus{} : block_.at(status.error(), CodeGroup::motion);
}

// A block without a move of the contour waits with all that it does.
BlockStatus BlockInterpreter::check_room() noexcept {
    if (!cutter_.has_entered()) {
        return {};
    }
    const int items = count_events() + (plan_.kind != PlanKind::none ? 1 : 0);
    if (!cutter_.has_room(items)) {
        return {ProgramError::cutter_far, 0, 0};
    }
    return ends_program() ? block_.at(cutter_.check_end().error(), CodeGroup::stop) : BlockStatus{};
}

} // namespace splinefeed
