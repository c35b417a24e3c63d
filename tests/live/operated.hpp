// SPDX-License-Identifier: MIT
// Operated: a machine that senders operate, in virtual time: all of `splinefeed serve` but its sockets.
#pragma once

#include "host_sim/live/live_machine.hpp"
#include "host_sim/serve/serve_settings.hpp"
#include "host_sim/serve/served_motion.hpp"
#include "live/shaft_world.hpp"

#include "splinefeed/controller/controller.hpp"

#include <array>

namespace splinefeed_test {

class Operated {
public:
    explicit Operated(ShaftWorld& world)
        : world_(&world), switches_(world.target().facts().switches),
          settings(host::serve_settings(world.machine(), switches_)), motion_(world.machine().machine, settings),
          live(world.target(), world.machine().machine, live_settings(world), [&world] { return world.outputs(); }),
          controller(settings, motion_.motion(), live, Controller::Memory{line_memory_, answer_memory_}) {}

    void send(std::string_view bytes) { controller.receive(bytes, now_ms()); }
    /// A millisecond, as the server has it.
    void tick() {
        world_->clock.sleep_us(1000);
        controller.execute(now_ms());
        FeedSegment segment;
        bool more = true;
        while (live.has_room() && (more = controller.next(segment, live.is_dry(), now_ms()) == Pull::item)) {
            live.submit(segment);
        }
        LineMotion& motion = motion_.motion();
        if (!more && motion.stream().at_rest() && (motion.exhausted() || live.is_dry())) {
            live.rest();
        }
        std::array<char, 512> part{};
        while (const std::size_t size = controller.take_answers(part)) {
            text.append(part.data(), size);
        }
    }
    /// Nothing is on its way.
    [[nodiscard]] bool rests() const {
        const ControllerState now = controller.state();
        return live.stands() && now != ControllerState::run && now != ControllerState::jog &&
               now != ControllerState::home;
    }

private:
    static host::LiveMachine::Settings live_settings(ShaftWorld& world) {
        return {.segment_ticks = world.segment_ticks(), .told = world.told(), .clock = &world.clock};
    }
    [[nodiscard]] std::uint32_t now_ms() const { return static_cast<std::uint32_t>(world_->clock.now_us() / 1000); }

    ShaftWorld* world_;
    host::SwitchFacts switches_;

public:
    ControllerSettings settings;
    std::string text; ///< what it has said

private:
    host::ServedMotion motion_;
    std::array<char, 4096> line_memory_{};
    std::array<char, 65536> answer_memory_{};

public:
    host::LiveMachine live;
    Controller controller;
};

} // namespace splinefeed_test
