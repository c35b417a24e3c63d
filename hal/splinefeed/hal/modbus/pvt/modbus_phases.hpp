// SPDX-License-Identifier: MIT
// ModbusPhases: the phases of a ModbusPort, what each event makes of them, and how long each may last.
//
//     filling -> starting -> running ----------------------------> done (all executed, at rest)
//                   ^           | a drive is about to run dry
//                   |           v
//                waiting <- stopping: every drive to the end of the same segment
//
// A stop that is asked for, and what a drive does not do in time, leads to halting, and from there to halted or fault.
#pragma once

#include "splinefeed/hal/modbus/pvt/port_times.hpp"
#include "splinefeed/hal/phase_machine.hpp"

namespace splinefeed::hal::modbus {

enum class ModbusPhase : std::uint8_t {
    filling,  ///< the drives stand and get segments
    starting, ///< they got a start, and not every one has confirmed it
    running,
    stopping, ///< all slow down to the end of the same segment
    waiting,  ///< they stand there, until every one can go on
    halting,  ///< a StopSequence stops them
    halted,
    done,
    fault,
    count
};

enum class ModbusEvent : std::uint8_t {
    ready,     ///< every drive can start, and has segments
    started,   ///< every drive has answered the start
    disturbed, ///< a drive is late, runs short of segments, has a problem or stopped by itself
    stands,    ///< every drive stands; one that does not answer must have come to the end of what it has
    executed,  ///< no more segments come, and every drive has executed all of them and stands
    broken,    ///< a drive has a problem that does not pass
    overdue,   ///< the phase has lasted longer than its bound
    stop,      ///< the user asks for a stop
    settled,   ///< every drive has confirmed its stop, or its time for that is over
    failed,    ///< the same, of a port that has a failure
    renewed,   ///< another motion may follow
    count
};

using ModbusPhases = PhaseMachine<ModbusPhase, ModbusEvent>;
[[nodiscard]] const ModbusPhases::Table& modbus_phase_table() noexcept;

/// What the bounds of the phases depend on. [us]
struct ModbusPhaseTimes {
    PortTimes port{};
    std::uint64_t ring_us = 0;    ///< motion that a drive's ring holds at most
    std::uint64_t command_us = 0; ///< from a command until its answer, with repetitions
    std::uint64_t start_us = 0;   ///< from a start command until all drives must have begun
    std::uint64_t stop_us = 0;    ///< longest StopSequence
};
[[nodiscard]] ModbusPhases::Bounds modbus_phase_bounds(const ModbusPhaseTimes& times) noexcept;

/// "filling", "ready", ...
[[nodiscard]] const char* name(ModbusPhase phase) noexcept;
[[nodiscard]] const char* name(ModbusEvent event) noexcept;

} // namespace splinefeed::hal::modbus
