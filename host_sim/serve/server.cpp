// SPDX-License-Identifier: MIT
#include "host_sim/serve/server.hpp"

#include "host_sim/base/number_text.hpp"
#include "host_sim/base/standard_streams.hpp"
#include "host_sim/serve/sender_guard.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace splinefeed::host {

namespace {

/// What a typed line asks for.
struct ConsoleOrder {
    std::string bytes{}; ///< for the controller
    std::string text{};  ///< for the operator, at once
    bool stops = false;  ///< anybody may send the byte, also while a sender has the machine
    bool leaves = false; ///< the server ends
};

constexpr std::string_view jog_use = "write: jog AXIS MM [FEED], for example jog x 10, or jog z -0.5 300 (mm/min)\n";

struct Word {
    std::string_view name;
    std::string_view bytes;
    bool stops;
    std::string_view help;
};
constexpr Word words[] = {
    {"status", "?", true, "where the machine stands, and what it does"},
    {"hold", "!", true, "brake on the path; resume goes on"},
    {"resume", "~", false, "go on"},
    {"reset", "\x18", true, "brake, and forget the program; twice: stop at once"},
    {"cancel", "\x85", true, "end a jog"},
    {"single", "\x89", false, "block by block, on or off: resume executes the next line"},
    {"home", "$H\n", false, "home all axes"},
    {"unlock", "$X\n", false, "end an alarm"},
    {"settings", "$$\n", false, "the machine's numbers"},
    {"offsets", "$#\n", false, "work offsets and the last probe"},
};

std::string help() {
    std::string out = "a line of G-code or a $ line, or one of\n";
    for (const Word& word : words) {
        out += fmt::format("  {:<10}{}\n", word.name, word.help);
    }
    out += "  jog       AXIS MM [FEED]: move an axis by so much\n  quit      end the server\n";
    return out;
}

// Relative, in mm.
ConsoleOrder jog(const std::vector<std::string>& typed) {
    double mm = 0.0;
    double feed = 600.0;
    const bool numbers = typed.size() >= 3 && typed.size() <= 4 && typed[1].size() == 1 &&
                         read_number(typed[2], mm) == NumberText::number &&
                         (typed.size() < 4 || read_number(typed[3], feed) == NumberText::number);
    if (!numbers) {
        return {.text = std::string(jog_use)};
    }
    return {.bytes = fmt::format("$J=G21 G91 {}{:.4f} F{:.3f}\n",
                                 static_cast<char>(std::toupper(static_cast<unsigned char>(typed[1][0]))), mm, feed)};
}

/// "jog x 10", "hold", "help", ...; everything else is a line of G-code or a `$` line.
ConsoleOrder console_order(std::string_view line) {
    std::istringstream stream{std::string(line)};
    const std::vector<std::string> typed{std::istream_iterator<std::string>(stream), {}};
    if (typed.empty()) {
        return {};
    }
    if (typed[0] == "jog") {
        return jog(typed);
    }
    if (typed.size() == 1 && (typed[0] == "help" || typed[0] == "?")) {
        return {.text = help()};
    }
    if (typed.size() == 1 && (typed[0] == "quit" || typed[0] == "exit")) {
        return {.leaves = true};
    }
    const auto* const word = std::ranges::find_if(words, [&](const Word& row) { return row.name == typed[0]; });
    if (word != std::end(words) && typed.size() == 1) {
        return {.bytes = std::string(word->bytes), .stops = word->stops};
    }
    return {.bytes = std::string(line) + "\n"};
}

constexpr std::size_t line_memory = std::size_t{256} << 10U;
constexpr std::size_t answer_memory = std::size_t{64} << 10U;
constexpr std::chrono::microseconds period{1000};
constexpr RealtimeByte reset_byte{RealtimeKind::reset};
constexpr std::string_view sign_of_life = "\xff"; // a byte that does nothing

} // namespace

Server::Server(const ControllerSettings& settings, ServedMotion& motion, LiveMachine& live, StateKeeper* state,
               const MachineState& begins, bool says)
    : motion_(&motion.motion()), live_(&live), state_(state), lines_(line_memory), answers_(answer_memory),
      text_(answer_memory), controller_(settings, *motion_, live, {lines_, answers_}), says_(says) {
    motion_->interpreter().restore(begins.offsets);
    offsets_ = motion_->interpreter().offsets();
    door_ = make_sender_door({
        .opened =
            [this](const std::string& name) {
                if (says_) {
                    tell("{} has the machine\n", name);
                }
                controller_.connect();
            },
        .received = [this](std::string_view bytes) { controller_.receive(bytes, now_ms()); },
        .stopped = [this](RealtimeByte byte) { controller_.act(byte); },
        .closed = [this] { controller_.disconnect(); },
        .rests =
            [this] {
                const ControllerState now = controller_.state();
                return is_at_rest() && now != ControllerState::run && now != ControllerState::jog;
            },
        .noted = [](const std::string& text) { tell("splinefeed: {}\n", printable(text)); },
    });
}

std::uint32_t Server::now_ms() const {
    const auto passed = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - start_);
    return static_cast<std::uint32_t>(passed.count());
}

void Server::type(std::string_view line) {
    const ConsoleOrder order = console_order(line);
    if (!order.text.empty()) {
        tell("{}", order.text);
    }
    leaves_ = leaves_ || order.leaves;
    if (order.bytes.empty() || !door_->has_sender()) {
        controller_.receive(order.bytes, now_ms());
        return;
    }
    if (order.stops) {
        controller_.act(realtime_byte(static_cast<std::uint8_t>(order.bytes.front())));
        return;
    }
    tell("a sender has the machine: hold, reset, cancel and status are taken here\n");
    for (const RealtimeByte byte : StopBytes().take(order.bytes)) {
        controller_.act(byte);
    }
}

void Server::obey(SignalWatch& signals) {
    for (; requests_ < SignalWatch::interrupts(); ++requests_) {
        controller_.act(reset_byte);
        leaves_ = true;
    }
    const UserSteering steering = signals.take_steering();
    if (steering != UserSteering::none) {
        suspend_.forget();
    }
    switch (steering) {
    case UserSteering::suspend: suspend_.ask(); break;
    case UserSteering::held: UserSuspend::tell_held(); [[fallthrough]];
    case UserSteering::hold: controller_.act({RealtimeKind::hold}); break;
    case UserSteering::resume: controller_.act({RealtimeKind::resume}); break;
    case UserSteering::none: break;
    }
}

// A search for references is stopped by that.
void Server::suspend() {
    if (leaves_) {
        suspend_.forget();
    } else if (suspend_.asked()) {
        controller_.act({RealtimeKind::hold});
        suspend_.follow(!is_at_rest(), 0, 0, live_->spindle_stands());
    }
}

bool Server::is_at_rest() const {
    return live_->stands() && motion_->stream().at_rest() && controller_.state() != ControllerState::home;
}

void Server::step() {
    controller_.execute(now_ms());
    FeedSegment segment;
    bool more = true;
    while (live_->has_room() && (more = controller_.next(segment, live_->is_dry(), now_ms()) == Pull::item)) {
        live_->submit(segment);
    }
    if (!more && motion_->stream().at_rest() && (motion_->exhausted() || live_->is_dry())) {
        live_->rest();
    }
}

void Server::answer() {
    while (const std::size_t size = controller_.take_answers(text_)) { // all of them: none is cut
        const std::string_view part(text_.data(), size);
        door_->send(part);
        if (says_ && !door_->has_sender()) {
            tell(part);
        }
    }
}

void Server::keep() {
    if (state_ == nullptr) {
        return;
    }
    if (const WorkOffsets& now = motion_->interpreter().offsets(); now != offsets_) {
        offsets_ = now;
        state_->offsets(now);
    }
    if (is_at_rest() && motion_->exhausted()) {
        live_->keep();
    }
}

void Server::run(SignalWatch& signals) {
    for (bool reset = false; !leaves_ || !live_->stands() || !motion_->stream().at_rest();) {
        door_->wait(period);
        obey(signals);
        leaves_ = leaves_ || (state_ != nullptr && state_->has_failed());
        if (leaves_ && !reset && requests_ == 0) {
            controller_.act(reset_byte);
        }
        reset = reset || leaves_;
        if (says_ && !door_->has_sender()) {
            controller_.receive(sign_of_life, now_ms()); // who types here does not poll
        }
        step();
        answer();
        keep();
        suspend();
    }
}

} // namespace splinefeed::host
