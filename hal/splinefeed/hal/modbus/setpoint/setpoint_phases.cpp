// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/setpoint/setpoint_phases.hpp"

namespace splinefeed::hal::modbus {

namespace {

using Phase = SetpointPhase;
using Event = SetpointEvent;

constexpr std::uint64_t second_us = 1'000'000;

struct PhaseChange {
    Phase from;
    Event event;
    Phase to;
};

constexpr std::array phase_changes{
    PhaseChange{Phase::filling, Event::filled, Phase::running},
    PhaseChange{Phase::running, Event::slows, Phase::stopping},
    PhaseChange{Phase::running, Event::ran_out, Phase::arriving},
    PhaseChange{Phase::arriving, Event::slows, Phase::stopping}, // from an instant before the end
    PhaseChange{Phase::arriving, Event::arrived, Phase::done},
    PhaseChange{Phase::stopping, Event::stands, Phase::starved},
    PhaseChange{Phase::starved, Event::filled, Phase::returning},
    PhaseChange{Phase::returning, Event::ready, Phase::running},
    PhaseChange{Phase::ending, Event::settles, Phase::halted},
    PhaseChange{Phase::ending, Event::fails, Phase::fault},
};

constexpr SetpointPhases::Table make_setpoint_table() {
    SetpointPhases::Table table{};
    for (std::size_t i = 0; i < SetpointPhases::phases; ++i) {
        table[i].fill(static_cast<Phase>(i));
        table[i][static_cast<std::size_t>(Event::stop)] = Phase::ending; // also to switch drives off at the end
        table[i][static_cast<std::size_t>(Event::trouble)] =
            i < static_cast<std::size_t>(Phase::halted) ? Phase::ending : static_cast<Phase>(i);
    }
    for (const PhaseChange& change : phase_changes) {
        table[static_cast<std::size_t>(change.from)][static_cast<std::size_t>(change.event)] = change.to;
    }
    return table;
}

constexpr SetpointPhases::Table table_of_phases = make_setpoint_table();

} // namespace

const char* name(SetpointPhase phase) noexcept {
    constexpr std::array<const char*, SetpointPhases::phases> names{
        "filling", "running", "arriving", "stopping", "starved", "returning", "ending", "halted", "done", "fault"};
    return names[static_cast<std::size_t>(phase)];
}

const char* name(SetpointEvent event) noexcept {
    constexpr std::array<const char*, SetpointPhases::events> names{"filled",  "slows", "stands",  "ready",   "ran_out",
                                                                    "arrived", "stop",  "trouble", "settles", "fails"};
    return names[static_cast<std::size_t>(event)];
}

const SetpointPhases::Table& setpoint_table() noexcept {
    return table_of_phases;
}

// What filling and starved wait for is the caller's: a pause of the program may last for hours. The drives are watched
// meanwhile, and every stop ends them.
SetpointPhases::Bounds setpoint_bounds(const SetpointPhaseTimes& times) noexcept {
    SetpointPhases::Bounds bounds{};
    bounds.fill({PhaseBound::final_us, ""});
    const auto set = [&](Phase phase, std::uint64_t most_us, const char* sentence) {
        bounds[static_cast<std::size_t>(phase)] = {most_us, sentence};
    };
    set(Phase::running, 2 * times.reserve_us + second_us, "the time of the motion does not go on");
    set(Phase::arriving, 5 * second_us,
        "it does not report that it has arrived; where its shaft dithers, give its axis a wider standstill_window_mm");
    set(Phase::stopping, 2 * times.reserve_us + second_us, "the time of the motion does not come to rest");
    set(Phase::returning, times.away_us + second_us,
        "it does not come to rest on the path after all drives have stopped; look for a load that moves it, or give "
        "its axis a wider standstill_window_mm");
    set(Phase::ending, times.longest_stop_us + second_us, "its stop does not end");
    return bounds;
}

} // namespace splinefeed::hal::modbus
