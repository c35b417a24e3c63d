// SPDX-License-Identifier: MIT
// setpoint_phases: the phases of a SetpointPort: what each event makes of each, and how long each may last.
// docs/reference/port_states.md has the same table for readers.
#pragma once

#include "splinefeed/hal/phase_machine.hpp"

namespace splinefeed::hal::modbus {

enum class SetpointPhase : std::uint8_t {
    filling,   ///< the drives stand; the first segments come
    running,   ///< targets follow the motion's clock
    arriving,  ///< the last target is sent
    stopping,  ///< the clock slows down for all drives
    starved,   ///< the clock stands; segments come
    returning, ///< segments are there; drives come back to the path
    ending,    ///< a stop was requested, StopSequence does it
    halted,    ///< the stop is over
    done,      ///< the motion is over, all drives have arrived
    fault,     ///< the stop is over; SetpointPort::trouble() is its reason
    count,
};

enum class SetpointEvent : std::uint8_t {
    filled,  ///< enough segments are buffered, or all that come
    slows,   ///< the clock began to slow down: segments or targets are late
    stands,  ///< the clock stands
    ready,   ///< it stands, all drives have answered since and are on the path, and those with blocks stand
    ran_out, ///< the motion's time is over
    arrived, ///< all drives stand at the end
    stop,    ///< a stop was requested
    trouble, ///< a drive does not follow, or a phase lasts too long
    settles, ///< every drive has confirmed its stop, or its time is over
    fails,   ///< the same, and there was trouble
    count,
};

using SetpointPhases = PhaseMachine<SetpointPhase, SetpointEvent>;

[[nodiscard]] const char* name(SetpointPhase phase) noexcept;
[[nodiscard]] const char* name(SetpointEvent event) noexcept;

[[nodiscard]] const SetpointPhases::Table& setpoint_table() noexcept;

/// Times of the machine. [us]
struct SetpointPhaseTimes {
    std::uint64_t reserve_us = 0;      ///< SetpointPortSettings
    std::uint64_t away_us = 0;         ///< SetpointPortSettings
    std::uint64_t longest_stop_us = 0; ///< of StopSequence
};
[[nodiscard]] SetpointPhases::Bounds setpoint_bounds(const SetpointPhaseTimes& times) noexcept;

} // namespace splinefeed::hal::modbus
