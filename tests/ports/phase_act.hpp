// SPDX-License-Identifier: MIT
// PhaseAct: what whoever plans does when a port comes into a phase, so that random runs do it in every phase.
#pragma once

#include "ports/run_plant.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>

namespace splinefeed_test {

enum class ActKind : std::uint8_t {
    hold,
    quick_stop,
    unfit, ///< gives it a segment that no register carries
    pause, ///< does nothing for a while: no segment, no poll
    count
};

template <class Phase>
struct PhaseAct {
    ActKind kind = ActKind::hold;
    Phase in{};
    std::uint64_t after_us = 0; ///< it came into the phase
    std::uint64_t pause_us = 0;

    [[nodiscard]] std::string text() const {
        constexpr std::array names{"hold", "quick stop", "unfit segment", "pause"};
        return std::string(" ") + names[static_cast<std::size_t>(kind)] + " in " + name(in) + " after " +
               std::to_string(after_us) + (kind == ActKind::pause ? " for " + std::to_string(pause_us) : "");
    }
    /// Whether a port may end in fault for it.
    [[nodiscard]] bool fatal() const { return kind == ActKind::unfit || kind == ActKind::pause; }
};

template <class Port>
void submit_unfit(Port& port) {
    splinefeed::FeedSegment segment;
    segment.duration_ticks = 8000;
    segment.end.fill(std::numeric_limits<std::int64_t>::max());
    CHECK_FALSE(port.submit(segment));
}

/// For Asked::also of the same `asked`, once.
template <class Plant, class Phase>
std::function<void(std::uint64_t)> act_in_phase(Plant& plant, Asked& asked, const PhaseAct<Phase>& act) {
    return [&plant, &asked, act, at_us = std::optional<std::uint64_t>(), acted = false](std::uint64_t now_us) mutable {
        at_us = !at_us && plant.port->phases().phase() == act.in ? std::optional(now_us + act.after_us) : at_us;
        if (acted || !at_us || now_us < *at_us) {
            return;
        }
        acted = true;
        switch (act.kind) {
        case ActKind::unfit: submit_unfit(*plant.port); return;
        case ActKind::pause:
            asked.paused_us += act.pause_us;
            plant.clock.sleep_us(act.pause_us);
            return;
        case ActKind::hold: plant.port->halt(); break;
        default: plant.port->quick_stop(); break;
        }
        asked.hold_us = std::min(asked.hold_us, now_us);
    };
}

/// Whoever plans goes on behind the end of a run: polls, asks for another stop or gives a segment that nobody carries.
/// @param kind  0 to 7
template <class Plant>
void act_behind_end(Plant& plant, std::uint64_t kind) {
    using splinefeed::hal::PortPhase;
    constexpr int some = 100;
    constexpr std::uint64_t longest_us = 30'000'000;
    auto& port = *plant.port;
    const auto poll_for = [&](int times) {
        for (int i = 0; i < times; ++i) {
            static_cast<void>(port.poll());
            plant.clock.sleep_us(1000);
        }
    };
    if (kind < 5) {
        poll_for(some);
    }
    switch (kind) {
    case 0: port.power_off(); break;
    case 1: port.quick_stop(); break;
    case 2: port.halt(); break;
    case 3: submit_unfit(port); break;
    default: break;
    }
    const std::uint64_t asked_us = plant.clock.now_us();
    while (port.poll().phase == PortPhase::running && plant.clock.now_us() < asked_us + longest_us) {
        plant.clock.sleep_us(1000);
    }
    poll_for(kind < 5 ? 3 : 0);
    CHECK(port.poll().phase != PortPhase::running);
}

} // namespace splinefeed_test
