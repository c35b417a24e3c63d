// SPDX-License-Identifier: MIT
// Controller: what lasts: settings, offsets and start-up lines of a machine that keeps them.
#include "splinefeed/controller/controller.hpp"

namespace splinefeed {

using namespace std::string_view_literals; // a firmware has no strlen

// Whoever keeps may write a flash, and a new number needs a new plan: at rest alone.
bool Controller::rests() noexcept {
    reading_ = machine_->read();
    return motion_->exhausted() && reading_.stands && !motion_->left_travel();
}

bool Controller::may_set() noexcept {
    const ControllerState now = activity();
    const bool may = (now == ControllerState::idle || now == ControllerState::alarm) && stands();
    if (!may) {
        refuse(LineError::not_now);
    }
    return may;
}

// Also behind a number that the machine has tried in vain: its motion has begun anew.
void Controller::take_settings() noexcept {
    sender_ = keeper_->sender();
    reading_ = machine_->read();
    motion_->place(reading_.position);
    set_overrides();
}

void Controller::set_number(std::int32_t number, Decimal value) noexcept {
    if (may_set()) {
        const bool done = keeper_->set(number, value, answers_);
        take_settings();
        done ? accept() : refuse(LineError::setting_disabled);
    }
}

// As grbl does it: a reset follows.
void Controller::forget_kept(KeptKind what) noexcept {
    if (!may_set()) {
        return;
    }
    const bool done = keeper_->forget(what, answers_);
    take_settings();
    if (!done) {
        refuse(LineError::setting_disabled);
        return;
    }
    restore_offsets();
    say("Restoring defaults");
    accept();
    begin_ending(Task::reset);
}

void Controller::restore_offsets() noexcept {
    motion_->interpreter().restore(keeper_->offsets());
}

void Controller::keep_offsets() noexcept {
    if (keeper_ != nullptr && offsets_changed_ && rests()) {
        offsets_changed_ = false;
        static_cast<void>(keeper_->keep(motion_->interpreter().offsets(), answers_));
    }
}

// As grbl does it: what is to be kept is executed first.
void Controller::take_start_up(unsigned line, std::string_view text) noexcept {
    if (activity() != ControllerState::idle || !rests()) {
        refuse(LineError::not_now);
    } else if (text.size() > SettingKeeper::longest_line) {
        say("A start-up line has at most 80 characters");
        refuse(LineError::start_up_too_long);
    } else if (!text.empty() && text[0] == '$') {
        say("A start-up line is G-code");
        refuse(LineError::unknown_command);
    } else if (text.empty()) {
        keeper_->keep(line, text, answers_) ? accept() : refuse(LineError::setting_disabled);
    } else {
        execute_start_up(line, text, LineOrigin::kept);
    }
}

// Lines of the program are counted without it.
void Controller::execute_start_up(unsigned line, std::string_view text, LineOrigin origin) noexcept {
    for (std::size_t i = 0; i < text.size(); ++i) {
        line_.text[i] = text[i]; // which may stand behind
    }
    line_.size = text.size();
    start_up_line_ = line;
    origin_ = origin;
    const std::uint32_t before = line_number_;
    execute_block(line_.view());
    line_number_ = before;
}

// Those of a machine that is locked are left out.
bool Controller::begin_start_up() noexcept {
    if (keeper_ == nullptr || is_locked() || mode_ != Mode::ready) {
        start_up_ = SettingKeeper::startup_lines;
    }
    if (start_up_ >= SettingKeeper::startup_lines) {
        return false;
    }
    const unsigned line = start_up_++;
    if (const std::string_view text = keeper_->startup_line(line); !text.empty()) {
        execute_start_up(line, text, LineOrigin::start_up);
    }
    return true;
}

bool Controller::keep_line() noexcept {
    if (!rests()) {
        return false;
    }
    const bool kept = keeper_->keep(start_up_line_, line_.view(), answers_);
    origin_ = LineOrigin::sender;
    drop_task();
    keep_offsets();
    kept ? accept() : refuse(LineError::setting_disabled);
    return true;
}

// It is carried out.
void Controller::end_line() noexcept {
    if (origin_ != LineOrigin::kept) {
        accept();
    } else if (is_locked()) {
        refuse(LineError::locked);
    } else {
        task_ = Task::keep;
    }
}

// false: it has nobody.
bool Controller::begin_answer() noexcept {
    if (std::exchange(origin_, LineOrigin::sender) != LineOrigin::start_up) {
        return !answers_nobody();
    }
    answers_.put('>').put(line_.view()).put(':');
    return true;
}

} // namespace splinefeed
