// SPDX-License-Identifier: MIT
// Controller: how motions end that are not to go on: jogs, resets, alarms.
#include "splinefeed/controller/controller.hpp"

namespace splinefeed {

using namespace std::string_view_literals; // a firmware has no strlen

// Also of jogs that wait, however far behind: their lines will have ok, and do nothing.
void Controller::cancel_jog() noexcept {
    cancelled_lines_ = lines_.lines() + (lines_.has_partial() ? 1U : 0U);
    if (!jogging_ || is_end(task_)) {
        return;
    }
    if (task_ == Task::jog) {
        end_task();
    }
    task_ = Task::jog_cancel;
    brake();
}

void Controller::stop_quickly(Alarm alarm) noexcept {
    machine_->quick_stop();
    quick_ = true;
    raise(alarm);
}

// The machine's own stop, where it has one: its segments need not be travelled to their end first.
void Controller::brake() noexcept {
    reading_ = machine_->read();
    quick_ = quick_ || (!reading_.stands && machine_->halt());
    stream().abort();
}

// A second reset, while the first one still brakes, is the hard one.
void Controller::begin_ending(Task end) noexcept {
    reading_ = machine_->read();
    origin_ = origin_ == LineOrigin::kept ? LineOrigin::sender : origin_;
    const bool second = task_ == Task::reset || task_ == Task::stop;
    const bool homes = task_ == Task::home;
    if (homes || (second && !stands())) {
        stop_quickly(homes ? Alarm::homing_reset : Alarm::stopped_in_motion);
        task_ = Task::reset;
        forget_lines();
        spindle_.stop_all();
        return;
    }
    if (end == Task::stop) {
        if (is_of_line(task_)) {
            end_task();
        }
        for (; lines_.lines() > 0; lines_.take(line_)) {
            accept();
        }
    }
    forget_lines();
    const Task before = task_;
    drop_task();
    task_ = before > end ? before : end; // a stop behind a reset takes nothing of it
    spindle_.stop_all();
    brake();
    if (end != Task::reset) {
        return;
    }
    quick_ = quick_ || mode_ == Mode::sleep || reading_.alarm != Alarm::none; // it may stand elsewhere then
    if (mode_ == Mode::sleep) {
        machine_->enable(true);
    }
    if (reading_.alarm != Alarm::none) {
        machine_->reset_faults();
    }
}

void Controller::raise(Alarm alarm, std::string_view sentence) noexcept {
    if (alarm_ == alarm) {
        return;
    }
    const AlarmRow& row = row_of(alarm);
    if (is_of_line(task_)) {
        drop_task();
        refuse(LineError::locked);
    }
    alarm_ = alarm;
    locked_ = locked_ || row.stays;
    take(ModeEvent::alarm);
    answers_.put("ALARM:").integer(static_cast<std::int64_t>(alarm)).end_line();
    say(sentence.empty() ? row.sentence : sentence);
    if (row.needs_reset) {
        spindle_.stop_all();
    }
    quick_ = quick_ || alarm == Alarm::drive_fault || alarm == Alarm::link_lost || alarm == Alarm::emergency_stop;
    refused_lines_ = lines_.lines(); // they were sent before
    refusal_ = LineError::locked;
    if (!is_end(task_)) {
        task_ = Task::alarm;
        brake();
    }
}

// An ending is over when the machine stands.
void Controller::settle() noexcept {
    const bool ended = quick_ ? reading_.stands : stands() && stream().activity() == Activity::aborted;
    if (!is_end(task_) || !ended) {
        return;
    }
    if (quick_) {
        motion_->place(reading_.position);
    } else {
        motion_->restart();
    }
    const Task end = std::exchange(task_, Task::none);
    quick_ = jogging_ = false;
    if (end == Task::reset) {
        end_reset();
    } else if (end == Task::stop) {
        take(ModeEvent::stop);
        say("Stop");
    }
    if (in_door()) { // it cancelled a jog
        stream().hold();
    }
    set_overrides();
}

// Modes as behind M2, without G92 and tool length; a greeting.
void Controller::end_reset() noexcept {
    BlockInterpreter& interpreter = motion_->interpreter();
    WorkOffsets offsets = interpreter.offsets();
    offsets.g92 = offsets.tool = {};
    offsets.g92_applies = false;
    interpreter.restart();
    interpreter.restore(offsets);
    offsets_changed_ = true;
    alarm_ = Alarm::none;
    overrides_ = {};
    line_number_ = 0;
    take(ModeEvent::reset);
    pace_ = Pace::flows;
    status_.refresh();
    greet();
    start_up_ = 0;
}

} // namespace splinefeed
