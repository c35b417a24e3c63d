// SPDX-License-Identifier: MIT
#include "waypoints/console.hpp"

#include "startup.hpp"

namespace firmware {

using splinefeed::Decimal;
using splinefeed::Error;
using splinefeed::Status;

namespace {

/// splinefeed::describe would take five kilobytes, most of it sentences about curves that are not here.
const char* sentence(Error error) {
    switch (error) {
    case Error::start_elsewhere: return "the machine stands elsewhere (? says where): begin there, or send at x,y,z";
    case Error::too_few_waypoints: return "a program needs two waypoints in different places before its end";
    case Error::move_too_long:
        return "the move is too long: at most 65536 mm, 512 mm where the planner computes in float";
    case Error::position_out_of_range: return "a position is within +-1048576 mm";
    default: return "the waypoint was refused";
    }
}

} // namespace

void Console::greet() noexcept {
    say("[boot ");
    say(board::name);
    say(board::watchdog_bit() ? " watchdog]\n" : "]\n");
}

void Console::poll() noexcept {
    obey_requests();
    if (waiting_) {
        give_waypoint();
    } else {
        read_lines();
    }
    report();
}

void Console::obey_requests() noexcept {
    if (serial_.asked(Serial::Request::hold)) {
        motion_.hold();
    }
    if (serial_.asked(Serial::Request::resume) && !broken_) {
        motion_.resume();
    }
    if (serial_.asked(Serial::Request::abort)) {
        char c = 0;
        while (serial_.pop(c) && c != Serial::abort_mark) { // lines that came before it
        }
        abort();
    }
    if (serial_.asked(Serial::Request::status)) {
        report_status();
    }
    if (serial_.bytes_lost()) {
        refuse_waypoint("the UART lost bytes: wait for each ok, or obey XOFF");
    }
}

/// The line that waits is answered; those behind it are forgotten.
void Console::abort() noexcept {
    if (waiting_) {
        waiting_ = false;
        refuse("aborted");
    }
    length_ = 0;
    too_long_ = broken_ = false;
    if (motion_.has_program()) {
        motion_.abort();
    } else {
        tell("aborted");
    }
}

/// At most one line.
void Console::read_lines() noexcept {
    char c = 0;
    while (serial_.pop(c)) {
        if (c == '\r') {
            continue;
        }
        if (c == Serial::abort_mark) { // it came after obey_requests()
            static_cast<void>(serial_.asked(Serial::Request::abort));
            abort();
            return;
        }
        if (c != '\n') {
            too_long_ = too_long_ || length_ == line_.size();
            if (!too_long_) {
                line_[length_++] = c;
            }
            continue;
        }
        const std::string_view line(line_.data(), length_);
        length_ = 0;
        if (too_long_) {
            too_long_ = false;
            refuse_waypoint("a line has at most 100 characters");
        } else {
            execute(parse_line(line, axes));
        }
        return;
    }
}

void Console::execute(const Command& command) noexcept {
    switch (command.verb) {
    case Verb::nothing: say("ok\n"); return;
    case Verb::waypoint:
        waypoint_.position = command.position;
        waypoint_.feed_mm_s = splinefeed::to_scalar<Real>(command.number);
        waypoint_.corner = command.corner;
        give_waypoint();
        return;
    case Verb::end:
        if (broken_) {
            refuse("the program is broken: abort (Ctrl-X)");
        } else {
            answer(motion_.finish());
        }
        return;
    case Verb::at:
        if (motion_.set_position(command.position)) {
            say("ok\n");
        } else {
            refuse("at is for a machine that stands without a program");
        }
        return;
    case Verb::feed:
        motion_.override_feed(splinefeed::to_scalar<Real>(command.number, 100));
        say("ok\n");
        return;
    case Verb::reset:
        broken_ = false;
        if (motion_.reset()) {
            say("ok\n");
        } else {
            refuse("reset is for a machine that an emergency stop or a limit switch has stopped");
        }
        return;
    case Verb::memory: report_memory(); return;
    case Verb::stall: // the watchdog resets the board, and where the machine stands is lost
        if (motion_.steps().active()) {
            refuse("stall is for a machine that stands");
            return;
        }
        stalled_ = true;
        say("ok\n");
        return;
    case Verb::invalid: refuse_waypoint(command.error); return;
    }
}

/// Pushes the waypoint, or keeps it; the host gets its answer when it has been pushed.
void Console::give_waypoint() noexcept {
    waiting_ = false;
    if (broken_) {
        refuse("the program is broken: abort (Ctrl-X)");
        return;
    }
    if (motion_.steps().stopped() != Stop::none) {
        refuse("the machine was stopped: send reset");
        return;
    }
    const Status status = motion_.push(waypoint_);
    waiting_ = status.error() == Error::no_room;
    if (!waiting_) {
        answer(status);
        broken_ = !status.ok() && motion_.has_program();
        if (broken_) {
            motion_.hold();
        }
    }
}

void Console::answer(Status status) noexcept {
    if (status.ok()) {
        say("ok\n");
    } else {
        refuse(sentence(status.error()));
    }
}

void Console::refuse(const char* reason) noexcept {
    say("error: ");
    say(reason);
    say("\n");
}

/// For what may have been a waypoint: without it the path would be another one.
void Console::refuse_waypoint(const char* reason) noexcept {
    refuse(reason);
    if (motion_.has_program()) {
        broken_ = true;
        motion_.hold();
    }
}

void Console::report() noexcept {
    switch (motion_.next_event()) {
    case Event::none: break;
    case Event::done: tell("done"); break;
    case Event::aborted: tell("aborted"); break;
    case Event::held: tell("held"); break;
    case Event::underrun: tell("underrun"); break;
    case Event::late: tell("late"); break;
    case Event::estop: tell("estop"); break;
    case Event::limit: tell("limit"); break;
    }
}

void Console::tell(const char* event) noexcept {
    say("[");
    say(event);
    say_position();
    say("]\n");
}

void Console::report_status() noexcept {
    const Steps& steps = motion_.steps();
    say(steps.stopped() == Stop::estop   ? "<estop"
        : steps.stopped() == Stop::limit ? "<limit"
        : broken_                        ? "<broken"
        : steps.active()                 ? "<moving"
        : motion_.has_program()          ? "<waiting"
                                         : "<idle");
    say_position();
    say(" ring ");
    say_number(static_cast<std::uint32_t>(steps.level()));
    say(" late ");
    say_number(steps.underruns());
    say(" ms ");
    say_number(steps.ticks() / (1000 / board::tick_us));
    say(">\n");
}

void Console::report_memory() noexcept {
    say("[stack ");
    say_number(stack_used());
    say(" of ");
    say_number(stack_size());
    say("]\nok\n");
}

void Console::say_number(std::uint32_t value, unsigned digits) noexcept {
    char text[11] = {};
    char* digit = text + sizeof text - 1;
    const char* const first = digit - digits;
    do {
        *--digit = static_cast<char>('0' + value % 10);
        value /= 10;
    } while (value != 0 || digit > first);
    say(digit);
}

/// In mm with six decimals: nearer to the count than half a step, so it names this count when it is sent back.
void Console::say_position() noexcept {
    constexpr std::int64_t billion_q32 = Decimal::one << 32;
    for (unsigned k = 0; k < axes; ++k) {
        const std::int64_t nm =
            splinefeed::product_quotient(motion_.steps().count(k), billion_q32, limits->steps_per_mm_q32[k]).raw;
        const std::uint64_t size = (static_cast<std::uint64_t>(nm < 0 ? -nm : nm) + 500) / 1000 * 1000;
        say(k == 0 ? " " : ",");
        say(nm < 0 ? "-" : "");
        say_number(static_cast<std::uint32_t>(size / Decimal::one));
        say(".");
        say_number(static_cast<std::uint32_t>(size % Decimal::one / 1000), 6);
    }
}

} // namespace firmware
