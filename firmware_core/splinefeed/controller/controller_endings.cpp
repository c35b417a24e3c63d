// SPDX-License-Identifier: MIT
// Controller: how motions end that are not to go on: jogs, resets, alarms.
#include "splinefeed/controller/controller.hpp"

namespace splinefeed {

using namespace std::string_view_literals; // a firmware has no strlen

// Also of jogs that wait, however far behind: their lines will have ok, and do nothing.
void Controller::cancel_jog() noexcept {
    cancelled_lines_ = lines_.lines() + (lines_.has_partial() ? 1U : 0U);
    if (!jogging_ || ending_ != Ending::none) {
        return;
    }
    if (task_ == Task::jog) {
        end_task();
    }
    ending_ = Ending::jog;
    brake();
}

void Controller::stop_homing(Alarm alarm) noexcept {
    machine_->quick_stop();
    quick_ = true;
    raise(alarm);
}

// In a hold '~' starts them again.
void Controller::switch_off_alone() noexcept {
    const ControllerState now = state();
    if (now == ControllerState::hold) {
        spindle_.suspend();
    } else if (now != ControllerState::run && now != ControllerState::door) {
        spindle_.stop_all();
    } else {
        return;
    }
    alone_ = false;
}

// The machine's own stop, where it has one: its segments need not be travelled to their end first.
void Controller::brake() noexcept {
    reading_ = machine_->read();
    quick_ = quick_ || (!reading_.stands && machine_->halt());
    motion_->abort();
}

// A second reset, while the first one still brakes, is the hard one.
void Controller::begin_ending(Ending ending) noexcept {
    reading_ = machine_->read();
    const bool second = ending_ == Ending::reset || ending_ == Ending::stop;
    if ((second && !stands()) || task_ == Task::home) {
        machine_->quick_stop();
        const Alarm alarm = task_ == Task::home ? Alarm::homing_reset : Alarm::stopped_in_motion;
        quick_ = true;
        ending_ = Ending::reset;
        raise(alarm);
        forget_lines();
        spindle_.stop_all();
        return;
    }
    if (ending == Ending::stop) {
        if (task_ != Task::none) {
            end_task();
        }
        for (; lines_.lines() > 0; lines_.take(line_)) {
            accept();
        }
    }
    forget_lines();
    drop_task();
    ending_ = ending;
    spindle_.stop_all();
    brake();
    if (ending != Ending::reset) {
        return;
    }
    quick_ = quick_ || sleep_ || reading_.alarm != Alarm::none; // it may stand elsewhere then
    if (sleep_) {
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
    if (task_ != Task::none) {
        drop_task();
        refuse(LineError::locked);
    }
    alarm_ = alarm;
    answers_.put("ALARM:").integer(static_cast<std::int64_t>(alarm)).end_line();
    say(sentence.empty() ? row.sentence : sentence);
    if (row.needs_reset) {
        spindle_.stop_all();
    }
    quick_ = quick_ || alarm == Alarm::drive_fault || alarm == Alarm::link_lost || alarm == Alarm::emergency_stop;
    held_ = door_ = closes_ = tool_ = false;
    refused_lines_ = lines_.lines(); // they were sent before
    refusal_ = LineError::locked;
    if (ending_ == Ending::none) {
        ending_ = Ending::alarm;
        brake();
    }
}

// An ending is over when the machine stands.
void Controller::settle() noexcept {
    const bool ended = quick_ ? reading_.stands : stands() && motion_->activity() == Activity::aborted;
    if (ending_ == Ending::none || !ended) {
        return;
    }
    if (quick_) {
        motion_->place(reading_.position);
    } else {
        motion_->restart();
    }
    const Ending ending = ending_;
    ending_ = Ending::none;
    quick_ = jogging_ = rests_ = false;
    held_ = ending == Ending::jog ? held_ : false;
    if (door_ && ending != Ending::reset) { // it cancelled a jog
        motion_->hold();
    }
    if (ending == Ending::reset) {
        end_reset();
    } else if (ending == Ending::stop) {
        say("Stop");
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
    locked_ = locked_ || sleep_ || row_of(alarm_).stays;
    alarm_ = Alarm::none;
    overrides_ = {};
    line_number_ = 0;
    check_ = sleep_ = tool_ = door_ = closes_ = single_ = steps_ = false;
    status_.refresh();
    greet();
}

} // namespace splinefeed
