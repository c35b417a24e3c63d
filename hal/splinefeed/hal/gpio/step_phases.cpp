// SPDX-License-Identifier: MIT
#include "splinefeed/hal/gpio/step_phases.hpp"

namespace splinefeed::hal::gpio {

namespace {

using Phase = StepPhase;
using Event = StepEvent;

struct Change {
    Phase from;
    Event event;
    Phase to;
};

// Where nothing is said, an event leaves the phase as it is.
constexpr Change changes[] = {
    {Phase::off, Event::start, Phase::settling},          {Phase::settling, Event::ready, Phase::opening},
    {Phase::settling, Event::quick_stop, Phase::halted},  {Phase::opening, Event::opened, Phase::filling},
    {Phase::opening, Event::quick_stop, Phase::halted},   {Phase::filling, Event::filled, Phase::running},
    {Phase::filling, Event::cut_off, Phase::halted},      {Phase::filling, Event::exhausted, Phase::done},
    {Phase::filling, Event::quick_stop, Phase::halted},   {Phase::running, Event::late, Phase::slowing},
    {Phase::running, Event::exhausted, Phase::done},      {Phase::running, Event::quick_stop, Phase::stopping},
    {Phase::slowing, Event::stands, Phase::starved},      {Phase::slowing, Event::exhausted, Phase::done},
    {Phase::slowing, Event::quick_stop, Phase::stopping}, {Phase::starved, Event::refilled, Phase::running},
    {Phase::starved, Event::cut_off, Phase::halted},      {Phase::starved, Event::quick_stop, Phase::halted},
    {Phase::stopping, Event::stands, Phase::halted},      {Phase::stopping, Event::exhausted, Phase::done},
    {Phase::done, Event::reset, Phase::filling},          {Phase::starved, Event::reset, Phase::filling},
    {Phase::halted, Event::reset, Phase::settling}, // perhaps its brake was never released
    {Phase::disabled, Event::clear, Phase::off},          {Phase::failed, Event::clear, Phase::off},
};

constexpr StepPhases::Table make_table() {
    StepPhases::Table table{};
    for (std::size_t phase = 0; phase < StepPhases::phases; ++phase) {
        const auto own = static_cast<Phase>(phase);
        table[phase].fill(own);
        if (switched_off(own)) {
            continue; // until they are cleared
        }
        table[phase][static_cast<std::size_t>(Event::disable)] = Phase::disabled;
        table[phase][static_cast<std::size_t>(Event::error)] = Phase::failed;
        if (!axes_move(own)) {
            table[phase][static_cast<std::size_t>(Event::park)] = Phase::off;
        }
        if (is_bounded(own)) {
            table[phase][static_cast<std::size_t>(Event::overdue)] = Phase::failed;
        }
    }
    for (const Change& change : changes) {
        table[static_cast<std::size_t>(change.from)][static_cast<std::size_t>(change.event)] = change.to;
    }
    return table;
}

// What time does not bring about within a second more was lost.
constexpr std::uint64_t more_us = 1'000'000;

} // namespace

constexpr StepPhases::Table step_phase_table = make_table();

StepPhases::Bounds step_phase_bounds(std::uint64_t settle_us, std::uint64_t release_us,
                                     std::uint64_t reserve_us) noexcept {
    constexpr PhaseBound final{PhaseBound::final_us, ""};
    StepPhases::Bounds bounds;
    bounds.fill(final);
    const auto set = [&](StepPhase phase, std::uint64_t most_us, const char* sentence) {
        bounds[static_cast<std::size_t>(phase)] = {most_us + more_us, sentence};
    };
    set(Phase::settling, settle_us, "the drives were not ready in time (settle_ms)");
    set(Phase::opening, release_us, "the brake was not open in time (release_ms)");
    set(Phase::running, 0, "the motion does not advance");
    set(Phase::slowing, 2 * reserve_us, "the axes did not slow down in time");
    set(Phase::stopping, 2 * reserve_us, "the axes did not come to standstill in time");
    return bounds;
}

} // namespace splinefeed::hal::gpio
