// SPDX-License-Identifier: MIT
// bus_rate: how many segments a bus carries.
#pragma once

#include "splinefeed/hal/modbus/pvt/modbus_bus.hpp"

namespace splinefeed::hal::modbus {

/// Shortest duration of a segment that the bus can carry to all its drives, with a margin for answers that have to be
/// asked for again: full blocks by the line's rate, and what the drives need besides, measured on some status reads
/// now. [us]
/// @pre the drives are open, the bus is not started
[[nodiscard]] double least_segment_us(ModbusBus& bus, const LinkTiming& timing) noexcept;

} // namespace splinefeed::hal::modbus
