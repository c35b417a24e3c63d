// SPDX-License-Identifier: MIT
// command_states: the states in which a drive accepts a command: the table of docs/reference/pvt_map.md.
#pragma once

#include "splinefeed/hal/modbus/pvt/pvt_map.hpp"

namespace splinefeed::host {

/// Checks only the state; some commands need more, for example an empty ring. false for an unknown command.
[[nodiscard]] bool fits(hal::modbus::PvtCommand command, hal::modbus::PvtState state) noexcept;

} // namespace splinefeed::host
