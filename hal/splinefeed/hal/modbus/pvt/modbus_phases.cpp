// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/pvt/modbus_phases.hpp"

#include "splinefeed/hal/modbus/pvt/drive_problem.hpp"

namespace splinefeed::hal::modbus {

namespace {

constexpr std::uint64_t phase_margin_us = 1'000'000; // for a host that is busy

// clang-format off
constexpr ModbusPhases::Table phases_of_port() noexcept {
    using enum ModbusPhase;
    return {{
    //               ready     started   disturbed  stands    executed  broken    overdue   stop      settled   failed    renewed
    /* filling  */ {{starting, filling,  filling,   filling,  done,     halting,  halting,  halting,  filling,  filling,  filling}},
    /* starting */ {{starting, running,  starting,  starting, starting, halting,  stopping, halting,  starting, starting, starting}},
    /* running  */ {{running,  running,  stopping,  running,  done,     halting,  halting,  halting,  running,  running,  running}},
    /* stopping */ {{stopping, stopping, stopping,  waiting,  stopping, halting,  halting,  halting,  stopping, stopping, stopping}},
    /* waiting  */ {{starting, waiting,  waiting,   waiting,  done,     halting,  halting,  halting,  waiting,  waiting,  waiting}},
    /* halting  */ {{halting,  halting,  halting,   halting,  halting,  halting,  fault,    halting,  halted,   fault,    halting}},
    /* halted   */ {{halted,   halted,   halted,    halted,   halted,   halted,   halted,   halting,  halted,   halted,   filling}},
    /* done     */ {{done,     done,     done,      done,     done,     halting,  done,     halting,  done,     done,     filling}},
    /* fault    */ {{fault,    fault,    fault,     fault,    fault,    fault,    fault,    halting,  fault,    fault,    filling}},
    }};
}
// clang-format on

constexpr ModbusPhases::Table phase_table = phases_of_port();

constexpr std::array phase_names{"filling", "starting", "running", "stopping", "waiting",
                                 "halting", "halted",   "done",    "fault"};
constexpr std::array event_names{"ready",   "started", "disturbed", "stands", "executed", "broken",
                                 "overdue", "stop",    "settled",   "failed", "renewed"};
static_assert(phase_names.size() == ModbusPhases::phases && event_names.size() == ModbusPhases::events);

} // namespace

const ModbusPhases::Table& modbus_phase_table() noexcept {
    return phase_table;
}

ModbusPhases::Bounds modbus_phase_bounds(const ModbusPhaseTimes& times) noexcept {
    using enum ModbusPhase;
    const auto reserve_us = static_cast<std::uint64_t>(times.port.reserve_us);
    const auto segment_us = static_cast<std::uint64_t>(times.port.segment_us);
    const auto bound = [](std::uint64_t most_us, DriveProblem problem) {
        return PhaseBound{most_us, describe(problem)};
    };
    const PhaseBound fed = bound(times.port.away_us + phase_margin_us, DriveProblem::takes_nothing);
    return ModbusPhases::bounds_of({
        {filling, fed},
        {waiting, fed},
        {starting, bound(times.start_us, DriveProblem::ignores)},
        {running, bound(times.port.away_us + 2 * segment_us + phase_margin_us, DriveProblem::frozen)},
        {stopping, bound(times.ring_us + 2 * reserve_us + times.command_us + times.port.silent_us + phase_margin_us,
                         DriveProblem::not_standing)},
        {halting, bound(times.stop_us + phase_margin_us, DriveProblem::not_standing)},
    });
}

const char* name(ModbusPhase phase) noexcept {
    return phase_names[static_cast<std::size_t>(phase)];
}

const char* name(ModbusEvent event) noexcept {
    return event_names[static_cast<std::size_t>(event)];
}

} // namespace splinefeed::hal::modbus
