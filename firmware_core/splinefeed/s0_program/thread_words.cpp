// SPDX-License-Identifier: MIT
// BlockInterpreter: G76, and the steps of G33.1.
#include "splinefeed/s0_program/block_interpreter.hpp"

namespace splinefeed {

BlockStatus BlockInterpreter::plan_thread() noexcept {
    const int x = letters_.index('x');
    const int z = letters_.index('z');
    if (x < 0 || z < 0) {
        return block_.at(ProgramError::axis_missing, CodeGroup::motion);
    }
    if (block_.has_any(Block::bits("abcuvw"))) {
        return block_.at(ProgramError::cycle_axis_word, CodeGroup::motion);
    }
    if (modal_.spindle == SpindleState::stopped) {
        return block_.at(ProgramError::spindle_stands, CodeGroup::motion);
    }
    const Place end = find_end();
    AxisPoint at = place_.program;
    Decimal& at_x = at[static_cast<unsigned>(x)];
    Decimal& at_z = at[static_cast<unsigned>(z)];
    ThreadCycle& cycle = series_.emplace<ThreadCycle>();
    if (const BlockStatus status = cycle.begin(block_, modal_, at_x, at_z, end.program[static_cast<unsigned>(z)]);
        !status.ok()) {
        return status;
    }
    for (const Decimal way : {cycle.taper_pitch(), cycle.pitch()}) {
        if (const BlockStatus status = set_feed_of_turns(way); !status.ok()) {
            return status;
        }
    }
    at_x = cycle.deepest_x();
    for (const Decimal level : {cycle.first_z(), cycle.last_z()}) {
        at_z = level;
        if (const BlockStatus status = check_reach(frame_.to_machine(at)); !status.ok()) {
            return status;
        }
    }
    plan_.manner.inverse_time = false;
    plan_.kind = PlanKind::thread;
    return move_to(end);
}

bool BlockInterpreter::next_of_thread(ProgramStep& out) noexcept {
    ThreadCycle* const cycle = std::get_if<ThreadCycle>(&series_);
    ThreadCycle::Move move;
    if (cycle == nullptr || !cycle->next(move)) {
        plan_.move = MoveKind::rapid;
        plan_.kind = PlanKind::none;
        fill_move(out, plan_.to);
        return true;
    }
    AxisPoint at = frame_.to_program(emitted_);
    at[letters_.place('x')] = move.x;
    at[letters_.place('z')] = move.z;
    plan_.move = move.cuts ? MoveKind::turning : MoveKind::rapid;
    if (move.cuts) {
        static_cast<void>(modal_.feed_of_turns(move.way_of_turn, plan_.manner.feed)); // plan_thread() has tried it
    }
    fill_move(out, frame_.to_machine(at));
    out.stops_before = move.waits;
    return true;
}

// G33.1: in, the spindle turns back, out, it turns as before.
bool BlockInterpreter::next_of_tap(ProgramStep& out, ProgramEvent& event) noexcept {
    switch (sub_step_) {
    case 0: fill_move(out, plan_.way); return true;
    case 1: turn_spindle(CycleStep::spindle_reverse, plan_.back_speed, out, event); break;
    case 2:
        plan_.manner.feed.raw =
            product_quotient(plan_.manner.feed.raw, plan_.back_speed.raw, static_cast<std::uint64_t>(modal_.speed.raw))
                .raw;
        fill_move(out, plan_.to);
        return true;
    default: turn_spindle(CycleStep::spindle_start, modal_.speed, out, event); plan_.kind = PlanKind::none;
    }
    ++sub_step_;
    return true;
}

} // namespace splinefeed
