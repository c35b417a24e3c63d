// SPDX-License-Identifier: MIT
// Controller: lines.
#include "splinefeed/controller/controller.hpp"

#include "splinefeed/s0_program/text/decimal_text.hpp"
#include "splinefeed/s0_program/words/axis_letters.hpp"

namespace splinefeed {

using namespace std::string_view_literals; // a firmware has no strlen

/// The `$` commands, by their words.
struct DollarCommands {
    struct Row {
        std::string_view word; // in lower case
        bool whole;            // nothing stands behind it
        bool idle;             // only in Idle and Alarm
        void (*run)(Controller&, TextCursor&);
    };

    static void help(Controller& c, TextCursor& /*rest*/) noexcept {
        c.answers_.put("[HLP:$$ $# $G $I $N $x=val"sv).put(c.keeper_ != nullptr ? " $Nx=line"sv : ""sv);
        c.answers_.put(" $J=line $SLP $C $X $H $RST=# ~ ! ? ctrl-x]").end_line();
        c.accept();
    }
    static void settings(Controller& c, TextCursor& /*rest*/) noexcept {
        c.setting_list().write(c.answers_);
        c.accept();
    }
    static void offsets(Controller& c, TextCursor& /*rest*/) noexcept {
        write_offsets(c.motion_->interpreter().offsets(), c.probe_, c.settings_->program, c.sender_.inches, c.answers_);
        c.accept();
    }
    static void modes(Controller& c, TextCursor& /*rest*/) noexcept {
        write_modes(c.motion_->interpreter(), c.spindle_, c.answers_);
        c.accept();
    }
    static void build(Controller& c, TextCursor& rest) noexcept {
        const bool axes = rest.take('+');
        if (!rest.at_end()) {
            disabled(c, rest);
            return;
        }
        write_build(*c.settings_, axes, c.answers_);
        c.accept();
    }
    static void startup(Controller& c, TextCursor& /*rest*/) noexcept {
        for (unsigned line = 0; line < SettingKeeper::startup_lines; ++line) {
            c.answers_.put("$N").integer(line).put('=');
            c.answers_.put(c.keeper_ != nullptr ? c.keeper_->startup_line(line) : ""sv).end_line();
        }
        c.accept();
    }
    static void keep_startup(Controller& c, TextCursor& rest) noexcept {
        const auto line = static_cast<unsigned>(rest.peek() - '0');
        if (c.keeper_ == nullptr) {
            disabled(c, rest);
            return;
        }
        rest.step();
        if (line >= SettingKeeper::startup_lines || !rest.take('=')) {
            c.refuse(LineError::unknown_command);
            return;
        }
        c.take_start_up(line, rest.at_end() ? ""sv : rest.part(rest.at(), rest.text().size()));
    }
    static void disabled(Controller& c, TextCursor& /*rest*/) noexcept {
        c.say("The machine file states this; nothing is written from here");
        c.refuse(LineError::setting_disabled);
    }
    static void check(Controller& c, TextCursor& /*rest*/) noexcept {
        if (c.mode_ == ControllerMode::check) {
            c.say("Disabled");
            c.accept();
            c.begin_ending(Controller::Task::reset);
        } else if (c.activity() == ControllerState::idle) {
            c.take(ModeEvent::check);
            c.say("Enabled");
            c.accept();
        } else {
            c.refuse(LineError::not_now);
        }
    }
    static void unlock(Controller& c, TextCursor& /*rest*/) noexcept {
        if (c.reading_.alarm != Alarm::none) {
            c.say("The cause of the alarm lasts: end it, then reset");
            c.refuse(c.reading_.alarm == Alarm::emergency_stop ? LineError::emergency_stop : LineError::locked);
        } else if (c.mode_ == ControllerMode::sleep || row_of(c.alarm_).needs_reset) {
            c.say("Reset to continue");
            c.refuse(LineError::locked);
        } else {
            if (c.is_locked()) {
                c.say("Caution: Unlocked");
            }
            c.alarm_ = Alarm::none;
            c.locked_ = false;
            c.accept();
        }
    }
    static void home(Controller& c, TextCursor& rest) noexcept {
        const AxisLetters letters(c.settings_->program);
        const std::uint32_t all = (1U << static_cast<unsigned>(letters.count())) - 1U;
        std::uint32_t axes = 0;
        for (; !rest.at_end() && letters.index(rest.peek()) >= 0; rest.step()) {
            axes |= 1U << static_cast<unsigned>(letters.index(rest.peek()));
        }
        const std::uint32_t some = c.settings_->homes & all;
        axes = axes != 0 ? axes : some != 0 ? some : all;
        const bool ready = c.activity() == ControllerState::idle ||
                           (c.activity() == ControllerState::alarm && !row_of(c.alarm_).needs_reset);
        if (!rest.at_end()) {
            c.refuse(LineError::unknown_command);
        } else if ((axes & ~some) != 0) {
            std::string_view before = "[MSG:No home of "sv;
            for (const unsigned k : indices(letters.count())) {
                if (((axes & ~some) >> k & 1U) != 0) {
                    c.answers_.put(before).put(upper_case(letters.letter(static_cast<int>(k))));
                    before = ", "sv;
                }
            }
            c.answers_.put(": ").put(c.settings_->no_home).put(']').end_line();
            c.refuse(LineError::no_homing);
        } else if (!ready || c.reading_.alarm != Alarm::none || (c.reading_.inputs & InputBits::door) != 0) {
            c.refuse(LineError::not_now);
        } else {
            c.task_ = Controller::Task::home;
            c.alarm_ = Alarm::none; // what stops it says so anew
            c.home_axes_ = axes;
            c.start_up_ = axes == some ? 0 : c.start_up_;
        }
    }
    static void jog(Controller& c, TextCursor& rest) noexcept {
        const ControllerState state = c.activity();
        const bool ready = state == ControllerState::jog || state == ControllerState::idle ||
                           (state == ControllerState::tool && c.motion_->exhausted() && c.stands());
        if (!ready) {
            c.refuse(c.is_locked() ? LineError::locked : LineError::not_now);
            return;
        }
        const std::string_view text = rest.part(rest.at(), rest.text().size());
        BlockStatus status = c.motion_->interpreter().push_jog(text, c.line_number_);
        if (!status.ok()) {
            status.column = static_cast<std::uint16_t>(status.column > 0 ? status.column + rest.at() : 0);
            c.refuse_block(status, true);
            return;
        }
        c.jogging_ = true;
        c.set_overrides();
        c.task_ = Controller::Task::jog;
    }
    static void sleep(Controller& c, TextCursor& /*rest*/) noexcept {
        c.accept();
        c.say("Sleeping");
        c.spindle_.stop_all();
        c.take(ModeEvent::sleep);
        c.locked_ = true;
        c.machine_->enable(false);
    }
    static void clear_offsets(Controller& c, TextCursor& /*rest*/) noexcept {
        WorkOffsets none;
        none.tool_number = c.motion_->interpreter().offsets().tool_number;
        c.motion_->interpreter().restore(none);
        c.offsets_changed_ = true;
        c.keep_offsets();
        c.accept();
    }
    template <KeptKind what>
    static void forget(Controller& c, TextCursor& rest) noexcept {
        c.keeper_ == nullptr ? disabled(c, rest) : c.forget_kept(what);
    }
    static void setting(Controller& c, TextCursor& rest) noexcept;

    static constexpr Row rows[] = {
        {"$$", true, false, settings},
        {"$#", true, false, offsets},
        {"$g", true, false, modes},
        {"$i", false, false, build},
        {"$n", true, false, startup},
        {"$n", false, false, keep_startup},
        {"$c", true, false, check},
        {"$x", true, false, unlock},
        {"$h", false, false, home},
        {"$j=", false, false, jog},
        {"$slp", true, true, sleep},
        {"$rst=#", true, true, clear_offsets},
        {"$rst=$", true, false, forget<KeptKind::settings>},
        {"$rst=*", true, false, forget<KeptKind::all>},
        {"$rst=", false, false, disabled},
        {"$", true, false, help},
    };
};

// $n=value: where nothing is kept, what is there already may be set.
void DollarCommands::setting(Controller& c, TextCursor& rest) noexcept {
    Decimal number;
    Decimal value;
    Decimal present;
    std::int32_t n = 0;
    rest.take('$');
    if (!read_decimal(rest, number).ok() || !to_integer(number, n) || !rest.take('=') ||
        !read_decimal(rest, value).ok() || !rest.at_end() || !c.setting_list().find(n, present)) {
        c.refuse(LineError::unknown_command);
        return;
    }
    if (c.keeper_ != nullptr) {
        c.set_number(n, value);
        return;
    }
    constexpr std::int64_t shown = Decimal::one / 1000;
    const std::int64_t apart = value.raw - present.raw;
    std::int32_t whole = 0;
    if (n == 10 || n == 13) {
        const std::int32_t most = n == 10 ? SenderSettings::most_mask : 1;
        if (!to_integer(value, whole) || whole < 0 || whole > most) {
            c.say(n == 10 ? "$10 has bits 0 to 8: reports have no modes and no substates"sv : "$13 is 0 or 1"sv);
            c.refuse(LineError::setting_disabled);
            return;
        }
        c.sender_.report_mask = n == 10 ? whole : c.sender_.report_mask;
        c.sender_.inches = n == 13 ? whole != 0 : c.sender_.inches;
    } else if (apart > shown || apart < -shown) {
        c.answers_.put("[MSG:$").integer(n);
        const std::string_view key = SettingList::key_of(n);
        c.answers_.put(key.empty() ? " is fixed"sv : " is "sv)
            .put(key)
            .put(key.empty() ? ""sv : " in the machine file"sv);
        c.answers_.put(']').end_line();
        c.refuse(LineError::setting_disabled);
        return;
    }
    c.accept();
}

void Controller::execute_line() noexcept {
    TextCursor cursor(line_.view());
    const bool late = refused_lines_ > 0; // it was sent before its sender knew
    refused_lines_ -= late && refused_lines_ != all_lines ? 1U : 0U;
    TextCursor jog = cursor;
    const bool cancelled = cancelled_lines_ > 0 && jog.take("$j="sv);
    cancelled_lines_ -= cancelled_lines_ > 0 ? 1U : 0U;
    TextCursor kept = cursor;
    const bool moves = cursor.peek() != '$' || cursor.peek_second() == 'j' || cursor.peek_second() == 'h' ||
                       (keeper_ != nullptr && kept.take("$n"sv) && !kept.at_end());
    if (line_.too_long) {
        say("A line has at most 256 characters beside comments");
        refuse(LineError::too_long);
    } else if (cursor.at_end() || cancelled) {
        accept();
    } else if (late && moves) {
        refuse(refusal_);
    } else if (cursor.peek() != '$') {
        execute_block(line_.view());
    } else {
        for (const DollarCommands::Row& row : DollarCommands::rows) {
            TextCursor rest = cursor;
            if (rest.take(row.word) && (!row.whole || rest.at_end())) {
                const ControllerState now = activity();
                const bool fits = !row.idle || now == ControllerState::idle || now == ControllerState::alarm;
                fits ? row.run(*this, rest) : refuse(LineError::not_now);
                return;
            }
        }
        DollarCommands::setting(*this, cursor);
    }
}

void Controller::execute_block(std::string_view text) noexcept {
    if (is_locked() || jogging_) {
        refuse(LineError::locked);
        return;
    }
    const bool begins = activity() == ControllerState::idle && now_ms_ - block_ms_ >= recount_ms;
    line_number_ = begins ? 1 : line_number_ + 1;
    block_ms_ = now_ms_;
    const BlockStatus status = motion_->push(text, line_number_);
    if (!status.ok()) {
        refuse_block(status);
    } else if (mode_ == Mode::check) {
        motion_->leave_out();
        if (motion_->interpreter().has_ended()) {
            motion_->interpreter().begin_next();
        }
        accept();
    } else {
        task_ = Task::line;
    }
}

// What is not of a program, or will be refused, does not wait.
bool Controller::waits_for_step() const noexcept {
    const bool taken = mode_ != Mode::check && !is_locked() && !in_door() && !jogging_ && refused_lines_ == 0;
    return pace_ == Pace::single && taken && lines_.lines() > 0 && !lines_.begins("$"sv);
}

// Lines that wait do not begin because it ends.
void Controller::switch_single_block() noexcept {
    if (waits_for_step()) {
        hold();
    }
    pace_ = pace_ == Pace::flows ? Pace::single : Pace::flows;
    say(pace_ == Pace::single ? "Single block: '~' executes one"sv : "Single block is off"sv);
}

bool Controller::answers_nobody() noexcept {
    const bool nobody = of_another_ > 0;
    of_another_ -= nobody ? 1U : 0U;
    return nobody;
}

void Controller::accept() noexcept {
    if (begin_answer()) {
        answers_.put("ok").end_line();
    }
}

void Controller::refuse(LineError error) noexcept {
    if (begin_answer()) {
        answers_.put("error:").integer(static_cast<std::int64_t>(error)).end_line();
    }
}

void Controller::refuse_block(const BlockStatus& status, bool jog) noexcept {
    answers_.put("[MSG:Error: ");
    if (origin_ != LineOrigin::sender) {
        answers_.put("$N").integer(start_up_line_);
    } else {
        jog ? answers_.put("jog") : answers_.integer(line_number_);
    }
    if (status.column > 0) {
        answers_.put(':').integer(status.column);
    }
    answers_.put(' ');
    for (const char* text = describe(status.error); *text != '\0'; ++text) {
        answers_.put(*text);
    }
    answers_.put(']').end_line();
    refuse_behind(line_error_of(status.error));
    if (status.error == ProgramError::program_aborted) { // its text names the fault
        refused_lines_ = all_lines;
        TextCursor text(line_.view());
        text.go_to(status.column - 1U);
        say(text.part(text.at(), text.find(')', text.at())));
    }
}

// Lines that had come before are refused, too, and what moves is held: the sender decides.
void Controller::refuse_behind(LineError error) noexcept {
    refusal_ = error;
    const bool of_program = origin_ == LineOrigin::sender;
    refuse(error);
    if (!settings_->holds_on_error || mode_ == Mode::check || jogging_ || !of_program) {
        return;
    }
    refused_lines_ = lines_.lines();
    if (!motion_->exhausted()) {
        hold();
        refused_lines_ = mode_ == Mode::held ? all_lines : refused_lines_;
    }
}

} // namespace splinefeed
