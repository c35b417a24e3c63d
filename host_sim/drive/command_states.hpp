// SPDX-License-Identifier: MIT
// command_states: in which states a drive takes a command, the table of docs/reference/pvt_map.md.
#pragma once

#include "splinefeed/hal/modbus/pvt/pvt_map.hpp"

namespace splinefeed::host {

/// The states alone: some commands ask for more, an empty ring for instance. Of an unknown command: false.
[[nodiscard]] bool fits(hal::modbus::PvtCommand command, hal::modbus::PvtState state) noexcept;

} // namespace splinefeed::host
