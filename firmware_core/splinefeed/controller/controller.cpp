// SPDX-License-Identifier: MIT
#include "splinefeed/controller/controller.hpp"

namespace splinefeed {

using namespace std::string_view_literals; // a firmware has no strlen

namespace {

constexpr int most_free_moves = 100;

Fixed percent(int value) noexcept {
    return from_integer<Fixed>(value) / from_integer<Fixed>(100);
}

} // namespace

Controller::Controller(const ControllerSettings& settings, LineMotion& motion, ControlledMachine& machine,
                       Memory memory, SettingKeeper* keeper) noexcept
    : settings_(&settings), motion_(&motion), machine_(&machine), keeper_(keeper), lines_(memory.lines),
      answers_(memory.answers), spindle_(settings, machine), reading_(machine.read()) {
    SPLINEFEED_ASSERT(memory.answers.size() >= least_answers);
    motion_->place(reading_.position);
    motion_->interpreter().set_outputs(machine);
    locked_ = !reading_.known;
    if (keeper_ != nullptr) {
        sender_ = keeper_->sender();
        restore_offsets();
        start_up_ = 0;
    }
}

void Controller::greet() noexcept {
    answers_.end_line().put("Grbl 1.1h ['$' for help]").end_line();
    if (is_locked()) {
        say("'$H'|'$X' to unlock");
    }
}

void Controller::connect() noexcept {
    answers_.clear();
    drop_partial();
    alone_ = false;
    of_another_ = lines_.lines() + (is_of_line(task_) && origin_ != LineOrigin::start_up ? 1U : 0U);
    status_.refresh();
    greet();
    if (mode_ == Mode::held) {
        say("Held: '~' goes on, a reset ends the program");
    }
}

void Controller::disconnect() noexcept {
    drop_partial();
    cancel_jog();
    const ControllerState now = state();
    if (now == ControllerState::run || now == ControllerState::home || mode_ == Mode::closing) {
        hold();
    }
    if (is_end(task_) || is_locked()) { // what would begin behind that has nobody to watch it
        forget_lines();
    }
    alone_ = true;
    left_ms_ = now_ms_;
}

void Controller::receive(std::string_view bytes, std::uint32_t now_ms) noexcept {
    now_ms_ = now_ms;
    byte_ms_ = bytes.empty() ? byte_ms_ : now_ms;
    for (const char c : bytes) {
        const RealtimeByte byte = bytes_.take(static_cast<std::uint8_t>(c), lines_.in_comment());
        if (byte.kind == RealtimeKind::none) {
            const std::size_t before = lines_.lines();
            if (!lines_.add(c)) {
                raise(Alarm::lines_lost);
            }
            line_ms_ = lines_.lines() != before ? now_ms : line_ms_;
        } else {
            act(byte);
        }
        left_ms_ = byte.kind != RealtimeKind::nothing ? now_ms : left_ms_;
    }
}

void Controller::act(RealtimeByte byte) noexcept {
    switch (byte.kind) {
    case RealtimeKind::report: write_status(false); break;
    case RealtimeKind::full_report: write_status(true); break;
    case RealtimeKind::parser_report:
        if (may_report()) {
            write_modes(motion_->interpreter(), spindle_, answers_);
        }
        break;
    case RealtimeKind::hold: hold(); break;
    case RealtimeKind::resume: resume(); break;
    case RealtimeKind::reset: begin_ending(Task::reset); break;
    case RealtimeKind::stop: begin_ending(Task::stop); break;
    case RealtimeKind::door: open_door(); break;
    case RealtimeKind::jog_cancel: cancel_jog(); break;
    case RealtimeKind::single_block: switch_single_block(); break;
    case RealtimeKind::spindle_stop:
        if (mode_ == Mode::held && stands()) {
            spindle_.toggle_spindle();
        }
        break;
    case RealtimeKind::flood: toggle(EventKind::flood_on); break;
    case RealtimeKind::mist: toggle(EventKind::mist_on); break;
    case RealtimeKind::feed_override:
    case RealtimeKind::rapids_override:
    case RealtimeKind::spindle_override:
        if (overrides_.obey(byte)) {
            set_overrides();
        }
        break;
    case RealtimeKind::none:
    case RealtimeKind::nothing: break;
    }
}

// A jog keeps its own feed.
void Controller::set_overrides() noexcept {
    stream().override_feed(percent(jogging_ ? 100 : overrides_.feed));
    stream().override_rapids(percent(overrides_.rapids));
    if (spindle_.override_percent() != overrides_.spindle) {
        spindle_.set_override(overrides_.spindle);
    }
}

void Controller::toggle(EventKind coolant) noexcept {
    const ControllerState now = state();
    const bool may = now == ControllerState::idle || now == ControllerState::run || now == ControllerState::hold;
    if (may && machine_->has_output(coolant, 0)) {
        spindle_.toggle(coolant);
    }
}

// Where a stop finds no motion that it could hold, what has come before it does not begin either.
void Controller::stop_waiting() noexcept {
    cancel_jog();
    if (jogging_ || is_end(task_) || is_locked()) {
        refused_lines_ = lines_.lines();
        refusal_ = LineError::locked;
    }
}

void Controller::hold() noexcept {
    stop_waiting();
    if (task_ == Task::home) {
        stop_quickly(Alarm::homing_reset);
    } else if (!is_locked() && !is_end(task_) && take(ModeEvent::hold)) { // a jog comes to its end
        stream().hold();
    }
}

void Controller::resume() noexcept {
    reading_ = machine_->read();
    if (in_door() && (reading_.inputs & InputBits::door) != 0) {
        say("The door is open: close it, then '~'");
        return;
    }
    if (!in_door() && (reading_.alarm != Alarm::none || is_end(task_))) {
        return;
    }
    refused_lines_ = refused_lines_ == all_lines ? lines_.lines() : refused_lines_;
    const bool held = mode_ == Mode::held;
    pace_ = !held && waits_for_step() ? Pace::step : pace_;
    if (take(ModeEvent::resume)) {
        spindle_.restore();
    }
    if (held) {
        stream().resume();
    }
}

void Controller::open_door() noexcept {
    if (task_ == Task::home) {
        stop_quickly(Alarm::homing_door);
    } else if (is_locked()) {
        stop_waiting();
    } else if (take(ModeEvent::door)) {
        stop_waiting();
        stream().hold();
        spindle_.suspend();
    }
}

// A line that waits will be executed.
ControllerState Controller::state() const noexcept {
    const ControllerState now = activity();
    return now != ControllerState::idle || lines_.lines() == 0 ? now
           : waits_for_step()                                  ? ControllerState::hold
           : lines_.begins("$J="sv)                            ? ControllerState::jog
                                                               : ControllerState::run;
}

ControllerState Controller::activity() const noexcept {
    if (task_ == Task::home) {
        return ControllerState::home;
    }
    if (is_locked() && mode_ != Mode::sleep) {
        return ControllerState::alarm;
    }
    if (mode_ == Mode::ready || mode_ == Mode::tool) {
        if (task_ == Task::reset || task_ == Task::stop) {
            return ControllerState::hold;
        }
        if (jogging_) {
            return ControllerState::jog;
        }
    }
    const bool moves = task_ != Task::none || !motion_->exhausted() || !reading_.stands;
    return mode_ == Mode::ready && moves ? ControllerState::run : shown_in(mode_);
}

void Controller::write_status(bool all) noexcept {
    if (!may_report()) {
        return;
    }
    reading_ = machine_->read();
    StatusReport::Content content;
    content.state = state();
    content.part = mode_ == Mode::closing ? 3 : stands() && (!in_door() || spindle_.settles()) ? 0 : 1;
    content.reading = &reading_;
    content.offsets = &motion_->interpreter().offsets();
    content.spindle = &spindle_;
    content.overrides = overrides_;
    content.free_moves = task_ == Task::line || task_ == Task::rest ? 0 : most_free_moves;
    const auto most = static_cast<std::size_t>(settings_->receive_bytes);
    content.free_bytes = lines_.room() < most ? lines_.room() : most;
    content.line = reading_.executes && !jogging_ ? motion_->line_of(reading_.waypoint) : 0;
    content.sender = sender_;
    status_.write(content, *settings_, all, answers_);
}

} // namespace splinefeed
