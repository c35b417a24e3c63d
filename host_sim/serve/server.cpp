// SPDX-License-Identifier: MIT
#include "host_sim/serve/server.hpp"

#include "host_sim/base/standard_streams.hpp"
#include "host_sim/serve/console.hpp"

namespace splinefeed::host {

namespace {

constexpr std::size_t line_memory = std::size_t{256} << 10U;
constexpr std::size_t answer_memory = std::size_t{64} << 10U;
constexpr std::chrono::microseconds period{1000};
constexpr RealtimeByte reset_byte{RealtimeKind::reset};
constexpr std::string_view sign_of_life = "\xff"; // a byte that does nothing

} // namespace

Server::Server(const ControllerSettings& settings, ServedMotion& motion, ServedMachine& tool, StateKeeper* state,
               const MachineState& begins, bool says)
    : motion_(&motion.motion()), tool_(&tool), state_(state), lines_(line_memory), answers_(answer_memory),
      text_(answer_memory), controller_(settings, *motion_, tool, {lines_, answers_}), says_(says),
      places_(tool.places()) {
    motion_->interpreter().restore(begins.offsets);
    door_ = make_sender_door({
        .opened =
            [this](const std::string& name) {
                if (says_) {
                    tell("{} has the machine\n", name);
                }
                controller_.connect();
            },
        .received = [this](std::string_view bytes) { controller_.receive(bytes, now_ms()); },
        .closed = [this] { controller_.disconnect(); },
        .idle = [this] { return controller_.state() == ControllerState::idle; },
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
    if (!order.bytes.empty() && !order.stops && door_->has_sender()) {
        tell("a sender has the machine: hold, reset, cancel and status are taken here\n");
    } else if (!order.bytes.empty()) {
        controller_.receive(order.bytes, now_ms());
    }
}

void Server::obey(SignalWatch& signals) {
    for (; requests_ < SignalWatch::interrupts(); ++requests_) {
        controller_.act(reset_byte);
        leaves_ = true;
    }
    switch (signals.take_steering()) {
    case UserSteering::hold:
    case UserSteering::held: controller_.act({RealtimeKind::hold}); break;
    case UserSteering::resume: controller_.act({RealtimeKind::resume}); break;
    case UserSteering::suspend:
    case UserSteering::none: break;
    }
}

void Server::step() {
    tool_->advance(Clock::now());
    controller_.execute(now_ms());
    if (controller_.state() == ControllerState::home) {
        moves();
    }
    FeedSegment segment;
    bool more = true;
    while (tool_->has_room() && (more = controller_.next(segment, tool_->is_dry(), now_ms()) == Pull::item)) {
        moves();
        tool_->submit(segment);
    }
    if (!more && motion_->at_rest() && (motion_->exhausted() || tool_->is_dry())) {
        tool_->rest();
    }
}

// Until it stands the state file knows no place.
void Server::moves() {
    if (!moved_ && state_ != nullptr) {
        state_->moves();
    }
    moved_ = true;
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
    if (tool_->take_offsets_change()) {
        state_->offsets(motion_->interpreter().offsets());
    }
    if (!tool_->stands() || !motion_->exhausted()) {
        return;
    }
    std::vector<RunTarget::AxisPlace> places = tool_->places(); // homing, an e-stop and sleep change them, too
    if (moved_ || places != places_) {
        state_->ends(places);
        places_ = std::move(places);
        moved_ = false;
    }
}

void Server::run(SignalWatch& signals) {
    for (bool reset = false; !leaves_ || !tool_->stands() || !motion_->at_rest();) {
        door_->wait(period);
        obey(signals);
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
    }
    moved_ = moved_ && state_ != nullptr;
    if (moved_) {
        state_->ends(tool_->places());
    }
}

} // namespace splinefeed::host
