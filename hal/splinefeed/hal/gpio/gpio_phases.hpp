// SPDX-License-Identifier: MIT
// GpioPhase, GpioEvent: the life of a GpioPort, and what each event makes of each of its phases.
#pragma once

#include "splinefeed/hal/phase_machine.hpp"

#include <cstdint>

namespace splinefeed::hal::gpio {

enum class GpioPhase : std::uint8_t {
    fresh,     ///< no line was changed
    searching, ///< axes find their references
    resting,   ///< a search was given up
    ready,     ///< no segment of the motion has come
    moving,
    whole, ///< all segments of the motion have come
    left,  ///< the drives are as they shall stay
    count
};

enum class GpioEvent : std::uint8_t {
    search,   ///< axes begin to find their references
    give_up,  ///< one was not found
    prepared, ///< a motion may begin
    segment,
    complete, ///< no more segments come
    leave,
    count
};

using GpioPhases = PhaseMachine<GpioPhase, GpioEvent>;

// A motion may follow whatever was before, and so may the end.
inline constexpr GpioPhases::Table gpio_phase_table = [] {
    constexpr GpioPhases::Change changes[] = {
        {GpioPhase::searching, GpioEvent::give_up, GpioPhase::resting},
        {GpioPhase::ready, GpioEvent::segment, GpioPhase::moving},
        {GpioPhase::ready, GpioEvent::complete, GpioPhase::whole},
        {GpioPhase::moving, GpioEvent::complete, GpioPhase::whole},
    };
    GpioPhases::Table table = GpioPhases::table_of(changes);
    for (auto& row : table) {
        row[static_cast<std::size_t>(GpioEvent::search)] = GpioPhase::searching;
        row[static_cast<std::size_t>(GpioEvent::prepared)] = GpioPhase::ready;
        row[static_cast<std::size_t>(GpioEvent::leave)] = GpioPhase::left;
    }
    return table;
}();

} // namespace splinefeed::hal::gpio
