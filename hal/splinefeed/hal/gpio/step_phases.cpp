// SPDX-License-Identifier: MIT
#include "splinefeed/hal/gpio/step_phases.hpp"

namespace splinefeed::hal::gpio {

namespace {

using Phase = StepPhase;
using Event = StepEvent;

constexpr StepPhases::Change changes[] = {
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
    StepPhases::Table table = StepPhases::table_of(changes);
    for (std::size_t i = 0; i < StepPhases::phases; ++i) {
        const auto phase = static_cast<Phase>(i);
        if (switched_off(phase)) {
            continue; // until they are cleared
        }
        StepPhases::cell(table, phase, Event::disable) = Phase::disabled;
        StepPhases::cell(table, phase, Event::error) = Phase::failed;
        if (!axes_move(phase)) {
            StepPhases::cell(table, phase, Event::park) = Phase::off;
        }
        if (is_bounded(phase)) {
            StepPhases::cell(table, phase, Event::overdue) = Phase::failed;
        }
    }
    return table;
}

// What time does not bring about within a second more was lost.
constexpr std::uint64_t more_us = 1'000'000;

} // namespace

constexpr StepPhases::Table step_phase_table = make_table();

StepPhases::Bounds step_phase_bounds(std::uint64_t settle_us, std::uint64_t release_us,
                                     std::uint64_t reserve_us) noexcept {
    return StepPhases::bounds_of({
        {Phase::settling, {settle_us + more_us, "the drives were not ready in time (settle_ms)"}},
        {Phase::opening, {release_us + more_us, "the brake was not open in time (release_ms)"}},
        {Phase::running, {more_us, "the motion does not advance"}},
        {Phase::slowing, {2 * reserve_us + more_us, "the axes did not slow down in time"}},
        {Phase::stopping, {2 * reserve_us + more_us, "the axes did not come to standstill in time"}},
    });
}

} // namespace splinefeed::hal::gpio
