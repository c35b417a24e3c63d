// SPDX-License-Identifier: MIT
// BlockInterpreter: the items of an executed block, in the order of execution.
#include "splinefeed/s0_program/block_interpreter.hpp"

#include "splinefeed/s0_program/text/decimal_text.hpp"

namespace splinefeed {

namespace {

enum Stage : std::uint8_t {
    comment,
    speed,
    tool_select,
    input_output,
    tool_change,
    spindle,
    speed_at_rest,
    coolant,
    override_mode,
    printer,
    dwell,
    offsets_changed,
    motion,
    assigning,
    ending,
    stop,
};

std::int32_t integer_of(const Block& block, char letter) noexcept {
    std::int32_t number = 0;
    static_cast<void>(to_integer(block.value(letter), number));
    return number;
}

void fill_input_output(const Block& block, ProgramEvent& event) noexcept {
    switch (block.code(CodeGroup::input_output)) {
    case 62: event.kind = EventKind::output_on_with_motion; break;
    case 63: event.kind = EventKind::output_off_with_motion; break;
    case 64: event.kind = EventKind::output_on; break;
    case 65: event.kind = EventKind::output_off; break;
    case 67:
    case 68:
        event.kind =
            block.code(CodeGroup::input_output) == 67 ? EventKind::analog_output_with_motion : EventKind::analog_output;
        event.stops = false;
        event.number = integer_of(block, 'e');
        event.value = block.value('q');
        return;
    default:
        event.kind = EventKind::input_wait;
        event.analog = block.has('e');
        event.wait = static_cast<InputWait>(integer_of(block, 'l'));
        event.value = block.value('q');
        event.number = integer_of(block, event.analog ? 'e' : 'p');
        return;
    }
    event.stops = false;
    event.number = integer_of(block, 'p');
}

void fill_override(const Block& block, ProgramEvent& event) noexcept {
    event.stops = false;
    switch (block.code(CodeGroup::override_mode)) {
    case 48: event.kind = EventKind::overrides_on; return;
    case 49: event.kind = EventKind::overrides_off; return;
    case 50: event.kind = EventKind::feed_override; break;
    case 51: event.kind = EventKind::spindle_override; break;
    case 52: event.kind = EventKind::adaptive_feed; break;
    default: event.kind = EventKind::feed_hold; break;
    }
    event.number = !block.has('p') || block.value('p').raw != 0 ? 1 : 0;
}

// Those that wait for a temperature or for the motion stop the machine.
void fill_printer(const Block& block, ProgramEvent& event) noexcept {
    event.kind = EventKind::printer;
    event.number = block.code(CodeGroup::printer);
    event.stops = event.number == 109 || event.number == 190 || event.number == 191 || event.number == 400 ||
                  event.number == 84 || event.number == 18;
    event.value = block.value(block.has('s') ? 's' : 'r');
    event.text = event.number == 117 ? block.text() : TextPart{}; // beside the others a comment is its own event
}

} // namespace

// Whether the present stage has an event.
bool BlockInterpreter::event_is_due() noexcept {
    switch (stage_) {
    case comment: return block_.comment() != CommentKind::none;
    case speed: // but behind M5: a spindle that is to stop takes no other speed before
    case speed_at_rest:
        return states_speed(block_, rules()) && (block_.code(CodeGroup::spindle) == 5) == (stage_ == speed_at_rest);
    case tool_select: return block_.has('t') && !block_.has(CodeGroup::printer);
    case input_output: return block_.has(CodeGroup::input_output);
    case tool_change: return block_.has(CodeGroup::tool_change);
    case spindle: return block_.has(CodeGroup::spindle);
    case coolant: return block_.has(CodeGroup::coolant);
    case override_mode: return block_.has(CodeGroup::override_mode);
    case printer: {
        const std::int16_t code = block_.code(CodeGroup::printer);
        return code != Block::no_code && code != 82 && code != 83;
    }
    case offsets_changed: return offsets_changed_;
    case assigning: return finish_assignments();
    case ending: return end_program();
    case stop: {
        const std::int16_t code = block_.code(CodeGroup::stop);
        return has_ended() || (code != Block::no_code && (code != 1 || settings_.optional_pause));
    }
    default: return false;
    }
}

BlockStatus BlockInterpreter::check_outputs() noexcept {
    struct Row {
        Stage at;
        CodeGroup group;
    };
    constexpr Row rows[] = {{input_output, CodeGroup::input_output}, {coolant, CodeGroup::coolant}};
    BlockStatus status;
    for (const Row& row : rows) {
        ProgramEvent event;
        stage_ = row.at;
        fill_event(event);
        const bool asks = event.kind == EventKind::input_wait || event.kind == EventKind::coolant_off;
        if (block_.has(row.group) && !asks && !outputs_->has_output(event.kind, event.number)) {
            status = block_.at(ProgramError::output_missing, row.group);
        }
    }
    stage_ = all_done;
    return status;
}

// Of the block, at most.
int BlockInterpreter::count_events() noexcept {
    int count = 1; // assignments may change offsets
    for (stage_ = 0; stage_ < motion; ++stage_) {
        count += event_is_due() || (stage_ == dwell && block_.code(CodeGroup::non_modal) == 40) ? 1 : 0;
    }
    stage_ = all_done;
    return count + (block_.has(CodeGroup::stop) ? 1 : 0);
}

void BlockInterpreter::fill_event(ProgramEvent& event) const noexcept {
    event = {};
    event.stops = true;
    switch (stage_) {
    case comment:
        event.kind = block_.comment() == CommentKind::print   ? EventKind::print
                     : block_.comment() == CommentKind::debug ? EventKind::debug
                                                              : EventKind::message;
        event.stops = false;
        event.text = block_.text();
        break;
    case tool_select:
        event.kind = EventKind::tool_select;
        event.stops = false;
        event.number = modal_.selected_tool;
        break;
    case input_output: fill_input_output(block_, event); break;
    case tool_change:
        event.kind = block_.code(CodeGroup::tool_change) == 6 ? EventKind::tool_change : EventKind::tool_set;
        event.number = frame_.offsets().tool_number;
        break;
    case spindle: {
        const std::int16_t code = block_.code(CodeGroup::spindle);
        event.kind = code == 3   ? EventKind::spindle_clockwise
                     : code == 4 ? EventKind::spindle_counterclockwise
                     : code == 5 ? EventKind::spindle_stop
                                 : EventKind::spindle_orient;
        event.value = code == 5 ? Decimal{} : code == 19 ? block_.value('r') : modal_.speed;
        event.number = code == 19 ? integer_of(block_, 'p') : 0;
        break;
    }
    case coolant: {
        const std::int16_t code = block_.code(CodeGroup::coolant);
        event.kind = code == 7 ? EventKind::mist_on : code == 8 ? EventKind::flood_on : EventKind::coolant_off;
        break;
    }
    case override_mode: fill_override(block_, event); break;
    case printer: fill_printer(block_, event); break;
    case offsets_changed:
    case assigning:
    case ending:
        event.kind = EventKind::offsets_changed;
        event.stops = false;
        break;
    case stop: {
        const std::int16_t code = block_.code(CodeGroup::stop);
        event.number = code == Block::no_code ? 0 : code;
        event.kind = has_ended() ? EventKind::program_end
                     : code == 0 ? EventKind::pause
                     : code == 1 ? EventKind::optional_pause
                                 : EventKind::pallet_pause;
        break;
    }
    default: // the two of the speed
        event.kind = EventKind::spindle_speed;
        event.value = modal_.speed;
        event.stops = rules().speed_stops;
    }
}

// Behind the motion of a block, which is made in the modes and the frame before, it assigns parameters of the control,
// and M2 and M30 end the program. True: offsets are others.
bool BlockInterpreter::finish_assignments() noexcept {
    offsets_changed_ = false;
    if (assigns()) {
        evaluator_->finish(*this);
    }
    return offsets_changed_;
}

bool BlockInterpreter::end_program() noexcept {
    const std::int16_t code = block_.code(CodeGroup::stop);
    if (code != 2 && code != 30) {
        return false;
    }
    progress_ = Progress::ended;
    modal_.end_program(settings_);
    const bool moves = frame_.offsets().active != 0;
    if (settings_.extension != nullptr) {
        settings_.extension->end_program();
    }
    if (moves || settings_.extension != nullptr) {
        frame_.offsets().active = 0;
        frame_changed();
    }
    return moves;
}

Pull BlockInterpreter::next_step(ProgramStep& out, ProgramEvent& event) noexcept {
    for (;; out = {}) {
        if (surface_.gives()) {
            give_piece(out, event);
            return Pull::item;
        }
        if (cutter_.gives()) {
            give_held(out, event);
        } else {
            manner_ = &plan_.manner;
            item_line_ = line_;
            const Pull pull = next_of_block(out, event);
            if (pull != Pull::item) {
                return pull;
            }
            if (hold_back(out, event)) {
                continue;
            }
        }
        if (!follow_radius(out, event)) {
            return Pull::item;
        }
    }
}

Pull BlockInterpreter::next_of_block(ProgramStep& out, ProgramEvent& event) noexcept {
    for (; stage_ <= stop; ++stage_) {
        if (stage_ == ending && cutter_.holds() && ends_program()) {
            cutter_.leave();
            give_held(out, event);
            return Pull::item;
        }
        if (stage_ == motion) {
            if (next_motion(out, event)) {
                if (plan_.kind == PlanKind::none && !block_.has(CodeGroup::stop) && !assigns()) {
                    stage_ = all_done; // the next call need not look
                }
                return Pull::item;
            }
            continue;
        }
        if (stage_ == dwell) {
            if (block_.code(CodeGroup::non_modal) != 40) {
                continue;
            }
            out.kind = ItemKind::dwell;
            out.stops_before = true;
            out.dwell_s = block_.value('p');
            ++stage_;
            return Pull::item;
        }
        if (event_is_due()) {
            fill_event(event);
            out.kind = ItemKind::event;
            out.stops_before = event.stops;
            ++stage_;
            return Pull::item;
        }
    }
    stage_ = all_done;
    block_.clear();
    return has_ended() ? Pull::finished : Pull::starved;
}

} // namespace splinefeed
