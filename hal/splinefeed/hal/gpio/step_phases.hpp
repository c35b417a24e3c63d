// SPDX-License-Identifier: MIT
// StepPhase, StepEvent: the phases of a StepPort, and what each event makes of each of them.
#pragma once

#include "splinefeed/hal/motion_port.hpp"
#include "splinefeed/hal/phase_machine.hpp"

namespace splinefeed::hal::gpio {

enum class StepPhase : std::uint8_t {
    off,      ///< the drives are not enabled
    settling, ///< the drives were enabled, and the brake is engaged
    opening,  ///< the brake was released
    filling,  ///< the axes can move, and the motion has not begun
    running,
    slowing,  ///< segments came too late: the clock slows down
    starved,  ///< the clock stands within the motion
    stopping, ///< a quick stop
    done,     ///< all steps of the motion were made
    halted,   ///< at standstill before the end of the motion, for good
    disabled, ///< by an emergency stop
    failed,   ///< disabled because of an error
    count
};

enum class StepEvent : std::uint8_t {
    start,      ///< the drives were enabled
    ready,      ///< they hold the axes, and the brake was released
    opened,     ///< the brake is open
    filled,     ///< there are enough segments to begin, and an edge
    late,       ///< what is known ends soon, and not at rest
    stands,     ///< the clock has come to standstill
    refilled,   ///< there are enough segments to go on
    cut_off,    ///< no more segments come, and the last one does not end at rest
    exhausted,  ///< all edges were made, and the motion ends at rest
    quick_stop, ///< asked for; also by stop() while axes move
    disable,
    error,   ///< a line cannot be set, a stall, a thread that stood still
    overdue, ///< the phase has lasted for longer than its bound
    reset,   ///< another motion follows
    park,    ///< the drives were disabled in order
    clear,   ///< behind a fault they may be enabled again
    count
};

using StepPhases = PhaseMachine<StepPhase, StepEvent>;

extern const StepPhases::Table step_phase_table;

/// @param settle_us, release_us  of the drives and the brake   @param reserve_us  half the time of a slow-down
[[nodiscard]] StepPhases::Bounds step_phase_bounds(std::uint64_t settle_us, std::uint64_t release_us,
                                                   std::uint64_t reserve_us) noexcept;

[[nodiscard]] constexpr bool axes_move(StepPhase phase) noexcept {
    return phase == StepPhase::running || phase == StepPhase::slowing || phase == StepPhase::stopping;
}
/// Time alone ends these; the others wait for segments, for as long as a program from a pipe likes, or for nothing.
[[nodiscard]] constexpr bool is_bounded(StepPhase phase) noexcept {
    return phase == StepPhase::settling || phase == StepPhase::opening || axes_move(phase);
}
/// The drives are off until clear().
[[nodiscard]] constexpr bool switched_off(StepPhase phase) noexcept {
    return phase == StepPhase::disabled || phase == StepPhase::failed;
}
[[nodiscard]] constexpr PortPhase port_phase(StepPhase phase) noexcept {
    return switched_off(phase)          ? PortPhase::fault
           : phase == StepPhase::halted ? PortPhase::halted
           : phase == StepPhase::done   ? PortPhase::idle
                                        : PortPhase::running;
}

} // namespace splinefeed::hal::gpio
