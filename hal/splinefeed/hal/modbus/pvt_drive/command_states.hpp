// SPDX-License-Identifier: MIT
// command_states: the states in which a drive accepts a command: the table of docs/reference/pvt_map.md.
#pragma once

#include "splinefeed/hal/modbus/pvt/pvt_map.hpp"

namespace splinefeed::hal::modbus {

namespace detail {

[[nodiscard]] constexpr unsigned states_of(PvtCommand command) noexcept {
    constexpr auto bit = [](PvtState state) {
        return 1U << static_cast<unsigned>(state);
    };
    switch (command) {
    case PvtCommand::none:
    case PvtCommand::quick_stop: return ~0U;
    case PvtCommand::enable: return bit(PvtState::disabled) | bit(PvtState::standing);
    case PvtCommand::disable: return bit(PvtState::disabled) | bit(PvtState::standing) | bit(PvtState::held);
    case PvtCommand::begin: return bit(PvtState::standing) | bit(PvtState::held);
    case PvtCommand::start:
    case PvtCommand::home:
    case PvtCommand::preset_position: return bit(PvtState::standing);
    case PvtCommand::hold:
    case PvtCommand::end: return bit(PvtState::running) | bit(PvtState::stopping) | bit(PvtState::held);
    case PvtCommand::resume: return bit(PvtState::held);
    case PvtCommand::fault_reset: return bit(PvtState::fault) | bit(PvtState::disabled);
    }
    return 0;
}

} // namespace detail

/// Checks only the state; some commands need more, for example an empty ring. false for an unknown command.
[[nodiscard]] constexpr bool fits(PvtCommand command, PvtState state) noexcept {
    return (detail::states_of(command) >> static_cast<unsigned>(state) & 1U) != 0;
}

/// Whether a start or a resume comes so late that the watchdog would have run out since: the host has left, and other
/// drives are elsewhere.
/// @param begin_us, now_us  of the drive's clock, which wraps  @param watchdog_ms  0: there is no watchdog
[[nodiscard]] constexpr bool comes_too_late(std::uint32_t begin_us, std::uint32_t now_us,
                                            std::uint16_t watchdog_ms) noexcept {
    const auto late_us = static_cast<std::int32_t>(now_us - begin_us);
    return watchdog_ms != 0 && late_us >= std::int32_t{watchdog_ms} * 1000;
}

} // namespace splinefeed::hal::modbus
