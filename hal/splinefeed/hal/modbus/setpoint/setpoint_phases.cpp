// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/setpoint/setpoint_phases.hpp"

namespace splinefeed::hal::modbus {

namespace {

using Phase = SetpointPhase;
using Event = SetpointEvent;

constexpr std::uint64_t second_us = 1'000'000;

constexpr SetpointPhases::Change phase_changes[] = {
    {Phase::filling, Event::filled, Phase::running},
    {Phase::running, Event::slows, Phase::stopping},
    {Phase::running, Event::ran_out, Phase::arriving},
    {Phase::arriving, Event::slows, Phase::stopping}, // from an instant before the end
    {Phase::arriving, Event::arrived, Phase::done},
    {Phase::stopping, Event::stands, Phase::starved},
    {Phase::starved, Event::filled, Phase::returning},
    {Phase::returning, Event::ready, Phase::running},
    {Phase::ending, Event::settles, Phase::halted},
    {Phase::ending, Event::fails, Phase::fault},
};

constexpr SetpointPhases::Table make_setpoint_table() {
    SetpointPhases::Table table = SetpointPhases::table_of(phase_changes);
    for (std::size_t i = 0; i < SetpointPhases::phases; ++i) {
        const auto phase = static_cast<Phase>(i);
        SetpointPhases::cell(table, phase, Event::stop) = Phase::ending; // also to switch drives off at the end
        SetpointPhases::cell(table, phase, Event::trouble) = phase < Phase::halted ? Phase::ending : phase;
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
    const std::uint64_t slow_down_us = 2 * times.reserve_us + second_us;
    return SetpointPhases::bounds_of({
        {Phase::running, {slow_down_us, "the time of the motion does not go on"}},
        {Phase::arriving,
         {5 * second_us, "it does not report that it has arrived; where its shaft dithers, give its axis a wider "
                         "standstill_window_mm"}},
        {Phase::stopping, {slow_down_us, "the time of the motion does not come to rest"}},
        {Phase::returning,
         {times.away_us + second_us, "it does not come to rest on the path after all drives have stopped; look for a "
                                     "load that moves it, or give its axis a wider standstill_window_mm"}},
        {Phase::ending, {times.longest_stop_us + second_us, "its stop does not end"}},
    });
}

} // namespace splinefeed::hal::modbus
