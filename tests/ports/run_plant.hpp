// SPDX-License-Identifier: MIT
// Runs a motion on a plant's port, as a planner's thread would, and asks for stops on the way.
#pragma once

#include "ports/smooth_motion.hpp"
#include "splinefeed/hal/motion_port.hpp"
#include "support/catch.hpp"

#include <functional>

namespace splinefeed_test {

/// When the user asks for what, after prepare(). [us]
struct Asked {
    std::uint64_t hold_us = UINT64_MAX;
    std::uint64_t quick_us = UINT64_MAX;
    std::uint64_t starved_from_us = UINT64_MAX;       ///< no segments come from then on
    std::uint64_t starved_to_us = UINT64_MAX;         ///< until then
    std::function<void(std::uint64_t now_us)> also{}; ///< called before each poll
    std::uint64_t paused_us = 0;                      ///< for so long `also` has kept the planner from its work
};

/// Until the port is done, has stopped or is in fault; running: it came to no end within 30 s, pauses aside.
template <class Plant>
splinefeed::hal::PortPhase run(Plant& plant, const SmoothMotion& motion, const Asked& asked) {
    using splinefeed::hal::PortPhase;
    auto& port = *plant.port;
    bool held = false;
    bool quick = false;
    PortPhase phase = PortPhase::running;
    for (;;) {
        const std::uint64_t now_us = plant.clock.now_us() - plant.began_us;
        if (!held && now_us >= asked.hold_us) {
            held = true;
            port.halt();
        }
        if (!quick && now_us >= asked.quick_us) {
            quick = true;
            port.quick_stop();
        }
        const bool starved = now_us >= asked.starved_from_us && now_us < asked.starved_to_us;
        while (!starved && plant.next < motion.segments.size() && port.room() > 0 &&
               port.submit(motion.segments[plant.next])) {
            ++plant.next;
        }
        if (plant.next == motion.segments.size()) {
            port.complete();
        }
        if (asked.also) {
            asked.also(now_us);
        }
        phase = port.poll().phase;
        if (phase != PortPhase::running || now_us > 30'000'000 + asked.paused_us) {
            return phase;
        }
        plant.clock.sleep_us(1000);
    }
}

/// Half a second later nothing has moved since.
template <class Plant>
void check_stands_since(Plant& plant, std::uint64_t instant_us) {
    plant.port.reset();
    plant.clock.sleep_us(500'000);
    for (const std::uint64_t moved_us : plant.moved_us) {
        CHECK(moved_us <= instant_us);
    }
}

} // namespace splinefeed_test
