// SPDX-License-Identifier: MIT
// BlockInterpreter: the motion of a block.
#include "splinefeed/s0_program/block_interpreter.hpp"

namespace splinefeed {

namespace {

constexpr Decimal longest = Decimal::from_integer(65536);
constexpr int coarse = 21; // bits left out of a radius and an angle in degrees, so that their product does not overflow
constexpr auto longest_arc = static_cast<std::int64_t>(65536.0 * 57.29577951308232 * 1e18 / 0x1p42);

bool is_feed_motion(std::int16_t motion) noexcept {
    return motion != 0 && motion != ModalState::no_motion;
}

bool needs_one_speed(std::int16_t motion) noexcept {
    return motion == 330 || motion == 331 || motion == 760 || taps(motion) || (motion >= 50 && motion <= 55);
}

} // namespace

SpacePoint BlockInterpreter::space(const AxisPoint& point) const noexcept {
    SpacePoint out{};
    for (unsigned k = 0; k < 3; ++k) {
        const int axis = letters_.index("xyz"[k]);
        out[k] = axis >= 0 ? point[static_cast<unsigned>(axis)] : Decimal{};
    }
    return out;
}

Decimal BlockInterpreter::axis_value(int axis) const noexcept {
    const Decimal value = block_.value(letters_.letter(axis));
    return letters_.kind(axis) == AxisKind::rotary ? value : modal_.in_mm(value);
}

// Where the words of the block lead to.
BlockInterpreter::Place BlockInterpreter::find_end() const noexcept {
    Place end = place_;
    const bool of_machine = block_.code(CodeGroup::non_modal) == 530; // G53: the words are machine coordinates
    for (int k = 0; k < letters_.count(); ++k) {
        if (has_axis(k)) {
            const bool incremental = letters_.kind(k) == AxisKind::extruder
                                         ? modal_.extruder_incremental
                                         : modal_.incremental || block_.is_step(letters_.letter(k));
            Decimal& to = (of_machine ? end.machine : end.program)[static_cast<unsigned>(k)];
            to = incremental && !of_machine ? to + axis_value(k) : axis_value(k);
        }
    }
    if (of_machine) {
        end.program = frame_.to_program(end.machine);
    } else {
        end.machine = frame_.to_machine(end.program);
    }
    return end;
}

BlockStatus BlockInterpreter::check_reach(const AxisPoint& to) const noexcept {
    for (int k = 0; k < letters_.count(); ++k) {
        const auto n = static_cast<unsigned>(k);
        const Decimal way = to[n] - place_.machine[n];
        const bool far = !is_position(to[n]);
        if (far || way > longest || way < -longest) {
            const ProgramError error = far ? ProgramError::position_out_of_range : ProgramError::move_too_long;
            return has_axis(k) ? block_.at(error, letters_.letter(k)) : BlockStatus{error, 0, 0};
        }
    }
    return {};
}

BlockStatus BlockInterpreter::move_to(const Place& end) noexcept {
    if (const BlockStatus status = check_reach(end.machine); !status.ok()) {
        return status;
    }
    plan_.to = end.machine;
    place_ = end;
    return {};
}

BlockStatus BlockInterpreter::require_feed() const noexcept {
    if (modal_.inverse_time && !block_.has('f')) {
        return block_.at(ProgramError::inverse_feed_missing, CodeGroup::motion);
    }
    return modal_.feed.raw > 0 ? BlockStatus{} : block_.at(ProgramError::feed_missing, CodeGroup::motion);
}

// The spindle is where it was told to be: nobody measures it.
BlockStatus BlockInterpreter::set_feed_of_turns(Decimal way) noexcept {
    const bool follows = modal_.surface.applies();
    if (modal_.speed.raw == 0 || (follows && modal_.spindle == SpindleState::stopped)) {
        return block_.at(ProgramError::spindle_stands, CodeGroup::motion);
    }
    if (follows) {
        plan_.manner.per_turn = true;
        return {};
    }
    return modal_.feed_of_turns(way, plan_.manner.feed) ? BlockStatus{}
                                                        : block_.at(ProgramError::feed_out_of_range, CodeGroup::motion);
}

// G33 and G33.1: the feed is K for each turn. With G33.1 the machine goes back, with a spindle that turns back.
BlockStatus BlockInterpreter::plan_turning(bool follows) noexcept {
    constexpr Decimal most = Decimal::from_integer(100);
    const bool taps = modal_.motion == 331;
    const Decimal faster = block_.has('i') ? block_.value('i') : Decimal{Decimal::one};
    if (block_.value('k').raw <= 0 || block_.has('f') || faster.raw < Decimal::one || faster > most) {
        return block_.at(ProgramError::turn_way_missing, CodeGroup::motion);
    }
    if (modal_.spindle == SpindleState::stopped) {
        return block_.at(ProgramError::spindle_stands, CodeGroup::motion);
    }
    if (const BlockStatus status = set_feed_of_turns(modal_.in_mm(block_.value('k'))); !status.ok()) {
        return status;
    }
    plan_.manner.inverse_time = false;
    plan_.move = MoveKind::turning;
    plan_.stops_before = taps || !follows; // it waits for the spindle's mark
    plan_.stop_at_end = taps;
    if (!taps) {
        return plan_line();
    }
    const Place place = place_;
    const BlockStatus status = plan_line();
    plan_.kind = PlanKind::tap;
    plan_.way = plan_.to;
    plan_.to = place.machine;
    place_ = place;
    plan_.back_speed.raw = product_quotient(modal_.speed.raw, faster.raw, static_cast<std::uint64_t>(Decimal::one)).raw;
    return status;
}

BlockStatus BlockInterpreter::plan_motion(const BlockUse& use, const ModalState& before) noexcept {
    const std::int16_t modeless = block_.code(CodeGroup::non_modal);
    plan_.manner = {modal_.path_mode,
                    modal_.inverse_time,
                    false,
                    modal_.feed_in_inches,
                    modal_.tolerance_mm,
                    modal_.chain_tolerance_mm,
                    modal_.feed,
                    modal_.spindle == SpindleState::stopped ? SurfaceSpeed{} : modal_.surface};
    if (modeless == 53) {
        return end_nurbs();
    }
    if (modeless == 280 || modeless == 300) {
        return plan_reference_move();
    }
    if (block_.code(CodeGroup::motion) == ModalState::no_motion) {
        modal_.set_motion(ModalState::no_motion, rules());
        cycle_words_.begun = false;
    }
    if (use.axes != AxisUse::motion) {
        return {};
    }
    modal_.set_motion(use.motion, rules());
    const bool cycle = is_cycle(use.motion);
    cycle_words_.begun = cycle_words_.begun && cycle;
    if (cycle && modal_.inverse_time) {
        return block_.at(ProgramError::inverse_feed_cycle, CodeGroup::motion);
    }
    if (modal_.surface.applies() && needs_one_speed(use.motion)) {
        return block_.at(ProgramError::surface_speed_unsuited, CodeGroup::motion);
    }
    if (use.motion == 330 || use.motion == 331) {
        return plan_turning(before.motion == 330);
    }
    if (use.motion == 760) {
        return plan_thread();
    }
    const bool rapid = use.motion == 0 && !(rules().rapid_has_feed && modal_.feed.raw > 0);
    if (is_feed_motion(use.motion) && !rapid) {
        BlockStatus status = require_feed();
        status = status.ok() && modal_.per_turn ? set_feed_of_turns(modal_.feed) : status;
        if (!status.ok()) {
            return status;
        }
    }
    plan_.move = rapid ? MoveKind::rapid : MoveKind::feed;
    plan_.stops_before = modeless == 530;
    switch (use.motion) {
    case 20:
    case 30: return plan_arc();
    case 50:
    case 51: return plan_spline(before);
    case 52: return plan_nurbs();
    case 55: return plan_point();
    case 382:
    case 383:
    case 384:
    case 385: return plan_probe();
    default: return cycle ? plan_cycle(before) : plan_line();
    }
}

BlockStatus BlockInterpreter::plan_line() noexcept {
    const Place end = find_end();
    plan_.kind = PlanKind::line;
    return move_to(end);
}

BlockStatus BlockInterpreter::plan_probe() noexcept {
    if (modal_.inverse_time || modal_.per_turn) {
        return block_.at(ProgramError::probe_inverse_time, CodeGroup::motion);
    }
    const AxisPoint from = place_.machine;
    const BlockStatus status = plan_line();
    if (status.ok() && plan_.to == from) {
        return block_.at(ProgramError::probe_too_short, CodeGroup::motion);
    }
    plan_.move = MoveKind::probe;
    plan_.probe = {modal_.motion >= 384, (modal_.motion & 1) == 0};
    plan_.stops_before = true;
    plan_.stop_at_end = true;
    set_probe(true, place_.program); // unless report_probe says otherwise
    return status;
}

BlockStatus BlockInterpreter::plan_arc() noexcept {
    const PlaneLetters plane = letters_of(modal_.plane);
    const int first = letters_.index(plane.axes[0]);
    const int second = letters_.index(plane.axes[1]);
    const int x = letters_.index('x');
    const int y = letters_.index('y');
    const int z = letters_.index('z');
    if (first < 0 || second < 0 || x > 2 || y > 2 || z > 2) {
        return block_.at(ProgramError::arc_axes_unsuited, CodeGroup::motion);
    }
    if (!has_axis(first) && !has_axis(second) && block_.has('r')) {
        return block_.at(ProgramError::arc_end_is_start, 'r');
    }
    const Place end = find_end();
    const auto i = static_cast<unsigned>(first);
    const auto j = static_cast<unsigned>(second);
    ArcGeometry arc;
    const BlockStatus status = find_arc(block_, modal_, rules(), {place_.program[i], place_.program[j]},
                                        {end.program[i], end.program[j]}, arc);
    if (!status.ok()) {
        return status;
    }
    if (settings_.extension != nullptr && !settings_.extension->turn_arc(arc.radius, arc.sweep_deg)) {
        return block_.at(ProgramError::arc_radius_zero, CodeGroup::motion);
    }
    if (arc.is_flat && !block_.has_any(Block::bits("abcuvwe"))) {
        plan_parabola(i, j, arc, end);
        return move_to(end);
    }
    AxisPoint centre = place_.program;
    centre[i] = arc.centre.first;
    centre[j] = arc.centre.second;
    plan_.kind = PlanKind::arc;
    plan_.arc = {space(frame_.to_machine(centre)), modal_.plane, arc.sweep_deg};
    for (const Decimal value : plan_.arc.centre) {
        if (!is_position(value)) {
            return block_.at(ProgramError::position_out_of_range, CodeGroup::motion);
        }
    }
    const std::int64_t sweep = arc.sweep_deg.raw < 0 ? -arc.sweep_deg.raw : arc.sweep_deg.raw;
    if ((arc.radius.raw >> coarse) * (sweep >> coarse) > longest_arc) {
        return block_.at(ProgramError::move_too_long, CodeGroup::motion);
    }
    return move_to(end);
}

// In the place of an arc whose centre is too far away. @param first, second  axes of its plane
void BlockInterpreter::plan_parabola(unsigned first, unsigned second, const ArcGeometry& arc,
                                     const Place& end) noexcept {
    AxisPoint control = place_.program; // across the plane it is half of the way
    for (unsigned k = 0; k < static_cast<unsigned>(letters_.count()); ++k) {
        control[k].raw += (end.program[k] - place_.program[k]).raw / 2;
    }
    control[first] = arc.control.first;
    control[second] = arc.control.second;
    BezierPlan& curve = series_.emplace<BezierPlan>();
    curve.degree = 2;
    curve.points[0] = space(place_.machine);
    curve.points[1] = space(frame_.to_machine(control));
    curve.points[2] = space(end.machine);
    plan_.kind = PlanKind::bezier;
}

BlockStatus BlockInterpreter::plan_cycle(const ModalState& before) noexcept {
    const AxisPoint at = place_.program;
    const bool idle = rules().idle_cycles && block_.has('l') && block_.value('l').raw == 0;
    if (idle) { // its words are those of the next hole
        block_.keep(~Block::letter_bit('l'));
    }
    CannedCycle& cycle = series_.emplace<CannedCycle>();
    if (const BlockStatus status =
            cycle.begin(block_, modal_, before, letters_, at, rules().cycles_apart, cycle_words_);
        !status.ok()) {
        return status;
    }
    if (idle) {
        return {};
    }
    plan_.kind = PlanKind::cycle;
    const AxisPoint end = cycle.end();
    AxisPoint bottom = end;
    bottom[letters_.place(letters_of(modal_.plane).axes[2])] = cycle.bottom();
    if (const BlockStatus status = check_reach(frame_.to_machine(bottom)); !status.ok()) {
        return status;
    }
    AxisPoint around = bottom; // a square about the holes that lie about X0 Y0, on its tip: turned it has them, too
    for (int corner = 0; corner < 4 && cycle.radius().raw > 0; ++corner) {
        const Decimal far{(corner < 2 ? 2 : -2) * cycle.radius().raw};
        around[letters_.place('x')] = corner % 2 == 0 ? far : Decimal{};
        around[letters_.place('y')] = corner % 2 == 0 ? Decimal{} : far;
        if (const BlockStatus status = check_reach(frame_.to_machine(around)); !status.ok()) {
            return status;
        }
    }
    return move_to({end, frame_.to_machine(end)});
}

} // namespace splinefeed
