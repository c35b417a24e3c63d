// SPDX-License-Identifier: MIT
// Controller: what lines ask for, and how it is done.
#include "splinefeed/controller/controller.hpp"

namespace splinefeed {

using namespace std::string_view_literals; // a firmware has no strlen

void Controller::execute(std::uint32_t now_ms) noexcept {
    now_ms_ = now_ms;
    lines_left_ = settings_->lines_a_call;
    reading_ = machine_->read();
    watch();
    settle();
    if (task_ == Task::none) {
        keep_offsets();
    }
    do {
        while (step()) {
        }
    } while (lines_left_ > 0 && motion_->look_ahead());
}

Pull Controller::next(FeedSegment& out, bool dry, std::uint32_t now_ms) noexcept {
    execute(now_ms);
    for (;;) {
        bool changed = false;
        while (step()) {
            changed = true;
        }
        if (quick_ || task_ == Task::home) {
            return Pull::starved;
        }
        const Pull pull = may_begin() ? motion_->next(out, supply(dry)) : Pull::starved;
        ProgramEvent event;
        while (!holds() && motion_->take_event(event)) {
            carry_out(event);
        }
        if (pull == Pull::item || pull == Pull::busy) {
            return pull;
        }
        if (motion_->left_travel() && motion_->exhausted() && reading_.stands && alarm_ == Alarm::none &&
            !is_end(task_)) {
            raise(Alarm::outside_travel);
        }
        if (!changed && !step()) {
            break;
        }
    }
    if (jogging_ && task_ == Task::none && lines_.lines() == 0 && motion_->exhausted() && reading_.stands) {
        jogging_ = false;
        set_overrides();
    }
    return Pull::starved;
}

// From standstill nothing moves before the spindle is as ordered, or while a tool is changed, but jogs.
bool Controller::may_begin() noexcept {
    return !stream().at_rest() || ((mode_ != Mode::tool || jogging_) && spindle_.settles());
}

// Whether the motion waits for more lines. A stop that is planned stays: what the machine needs early, because its ring
// begins to fill, does not end a motion whose lines come.
Supply Controller::supply(bool dry) const noexcept {
    const bool waits = task_ != Task::none && task_ != Task::line && task_ != Task::jog;
    if (waits || pace_ != Pace::flows || motion_->left_travel()) {
        return Supply::pauses;
    }
    const bool pauses = now_ms_ - line_ms_ >= (jogging_ ? jog_pause_ms : pause_ms);
    if (stream().at_rest()) {
        // Held it can wait, however slowly the lines come.
        return lines_.lines() == 0 && pauses && !holds() ? Supply::pauses : Supply::flows;
    }
    const bool takes_none = dry && (lines_left_ > 0 || lines_.lines() == 0);
    return !takes_none ? Supply::flows : pauses ? Supply::pauses : Supply::late;
}

// What the machine itself says.
void Controller::watch() noexcept {
    if (reading_.alarm != Alarm::none && reading_.alarm != alarm_) {
        raise(reading_.alarm, reading_.alarm_sentence);
    }
    if (reading_.note.size() != noted_) {
        noted_ = reading_.note.size();
        if (noted_ > 0) {
            say(reading_.note);
        }
    }
    if (jogging_ && settings_->jog_timeout_ms > 0 && now_ms_ - byte_ms_ > settings_->jog_timeout_ms) {
        cancel_jog();
    }
    const std::uint32_t most_ms = settings_->unattended_ms;
    if (alone_ && spindle_.is_on() && most_ms > 0 && now_ms_ - left_ms_ > most_ms) {
        hold();
        holds() ? spindle_.suspend() : spindle_.stop_all(); // in a hold '~' starts them again
    }
    if (task_ == Task::probe && reading_.touched) {
        task_ = Task::touched;
        stream().abort();
    }
    if ((reading_.inputs & InputBits::door) != 0 && (task_ == Task::home || !is_locked())) {
        open_door();
    }
    if (mode_ == Mode::closing && spindle_.settles()) {
        take(ModeEvent::settled);
        stream().resume();
    }
}

// One step of the lines. false: nothing can be done now.
bool Controller::step() noexcept {
    if (answers_.room() < answer_room) {
        return false;
    }
    if (task_ != Task::none) {
        return go_on();
    }
    if (begin_start_up()) {
        return true;
    }
    const bool waits =
        (mode_ == Mode::tool || (in_door() && refused_lines_ == 0)) && lines_.lines() > 0 && !lines_.begins("$"sv);
    if (lines_.lines() == 0 || lines_left_ == 0 || waits || waits_for_step()) {
        return false;
    }
    if (motion_->pass_on() == BlockProgress::full) { // of a curve that a pause of the input has ended
        return false;
    }
    --lines_left_;
    pace_ = pace_ == Pace::step ? Pace::single : pace_;
    lines_.take(line_);
    execute_line();
    return true;
}

bool Controller::go_on() noexcept {
    switch (task_) {
    case Task::line:
    case Task::rest: return go_on(motion_->pass_on());
    case Task::jog: return go_on(motion_->pass_jog());
    case Task::dwell:
        if (holds() || static_cast<std::int32_t>(now_ms_ - until_ms_) < 0) {
            return false;
        }
        break;
    case Task::spindle:
    case Task::tool:
    case Task::input:
        reading_ = machine_->read();
        if (!reading_.spindle_ready || !spindle_.settles()) {
            return false;
        }
        if (task_ == Task::input) {
            motion_->interpreter().report_input(Decimal::from_integer(reading_.input));
            if (reading_.input < 0) { // what depends on it is the operator's to decide
                pause("M66: its input has not come in time: '~' goes on, a reset ends the program"sv);
            }
        } else if (task_ == Task::tool) {
            take(ModeEvent::tool); // who changes it reaches for the spindle, which stands now
            answers_.put("[MSG:Change to tool ")
                .integer(motion_->waiting().event.number)
                .put(": '~' goes on]")
                .end_line();
        }
        break;
    case Task::probe:
    case Task::touched: return finish_probe();
    case Task::home: return go_home();
    case Task::keep: return keep_line();
    default: return false; // an end
    }
    motion_->carried_out();
    task_ = Task::line;
    return true;
}

bool Controller::go_on(BlockProgress progress) noexcept {
    if (progress == BlockProgress::done) {
        end_task();
    }
    if (progress != BlockProgress::waits) {
        return progress == BlockProgress::done;
    }
    if (motion_->waiting().needs_rest()) {
        reading_ = machine_->read();
        task_ = Task::rest;
        if (holds() || mode_ == Mode::tool || !motion_->exhausted() || !reading_.stands || motion_->left_travel()) {
            return false;
        }
    }
    task_ = Task::line;
    return carry_out();
}

void Controller::end_task() noexcept {
    drop_task();
    keep_offsets();
    end_line();
}

void Controller::drop_task() noexcept {
    if (task_ == Task::input) {
        machine_->forget_input();
    }
    task_ = Task::none;
}

bool Controller::carry_out() noexcept {
    const LineMotion::Waiting& waiting = motion_->waiting();
    switch (waiting.kind) {
    case ItemKind::dwell:
        until_ms_ = now_ms_ + static_cast<std::uint32_t>((waiting.dwell_s.raw + 999'999) / 1'000'000);
        task_ = Task::dwell;
        return true;
    case ItemKind::move:
        if (waiting.move == MoveKind::probe) {
            begin_probe();
            return true;
        }
        break;
    case ItemKind::event: carry_out(waiting.event); break;
    }
    if (task_ == Task::line) {
        motion_->carried_out();
    }
    return true;
}

void Controller::pause(std::string_view sentence) noexcept {
    take(ModeEvent::hold);
    stream().hold();
    say(sentence);
}

void Controller::carry_out(const ProgramEvent& event) noexcept {
    switch (event.kind) {
    case EventKind::message:
    case EventKind::print:
    case EventKind::debug: say(event.text.of(line_.view())); return;
    case EventKind::offsets_changed: offsets_changed_ = true; return;
    case EventKind::pause:
    case EventKind::optional_pause:
    case EventKind::pallet_pause: pause("Program paused: '~' goes on"sv); return;
    case EventKind::input_wait:
        if (!event.analog && machine_->has_output(event.kind, event.number)) {
            machine_->obey(event);
            task_ = Task::input;
            return;
        }
        pause("M66: there is no input of this number: '~' goes on, a reset ends the program"sv);
        return;
    case EventKind::tool_change:
        spindle_.stop_all();
        task_ = Task::tool;
        return;
    case EventKind::program_end:
        spindle_.stop_all();
        motion_->interpreter().begin_next();
        motion_->begin_program();
        line_number_ = 0;
        say("Pgm End");
        return;
    default: break;
    }
    if (!spindle_.obey(event)) {
        machine_->obey(event);
    } else if (event.stops) {
        task_ = Task::spindle;
    }
}

void Controller::begin_probe() noexcept {
    const ProbeCondition probe = motion_->waiting().probe;
    const bool touches = ((reading_.inputs & InputBits::probe) != 0) != probe.away;
    if (settings_->probes && !touches) {
        machine_->watch_probe(probe.away);
        motion_->begin_waiting();
        task_ = Task::probe;
        return;
    }
    motion_->restart();
    drop_task();
    if (settings_->probes) {
        raise(Alarm::probe_at_start);
        end_line();
    } else {
        say("The machine has no probe");
        refuse_behind(LineError::unsupported_word);
    }
}

bool Controller::finish_probe() noexcept {
    reading_ = machine_->read();
    const bool ended = stream().activity() == Activity::aborted || motion_->exhausted() || motion_->left_travel();
    if (!ended || !stands()) {
        return false;
    }
    const bool required = motion_->waiting().probe.required;
    const bool contact = reading_.touched;
    motion_->restart();
    set_overrides();
    BlockInterpreter& interpreter = motion_->interpreter();
    const PerAxis<Position> place = interpreter.position();
    interpreter.report_probe(contact, contact ? reading_.touched_at : place, place);
    for (const unsigned k : indices(settings_->program.axes)) {
        probe_.at[k] = to_decimal(contact ? reading_.touched_at[k] : place[k]);
    }
    probe_.contact = contact;
    drop_task();
    if (required && !contact) { // grbl's order: who waits for ok alone sees the alarm before
        raise(Alarm::probe_without_contact);
    }
    write_probe(probe_, settings_->program, sender_.inches, answers_);
    end_line();
    return true;
}

bool Controller::go_home() noexcept {
    if (home_axes_ != 0 && spindle_.settles()) {
        machine_->home(std::exchange(home_axes_, 0U));
    }
    reading_ = machine_->read();
    if (home_axes_ != 0 || reading_.homing == HomingPhase::busy) {
        return false;
    }
    task_ = Task::none;
    motion_->place(reading_.position);
    set_overrides();
    if (reading_.homing == HomingPhase::failed || reading_.homing == HomingPhase::not_cleared) {
        refuse(LineError::locked);
        raise(reading_.homing == HomingPhase::failed ? Alarm::homing_not_found : Alarm::homing_pull_off,
              reading_.alarm_sentence);
    } else {
        locked_ = locked_ && !reading_.known; // the other axes, too
        alarm_ = Alarm::none;
        if (locked_) {
            say("Axes are still to be homed: '$H'|'$X' to unlock");
        }
        accept();
    }
    return true;
}

} // namespace splinefeed
