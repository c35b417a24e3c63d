// SPDX-License-Identifier: MIT
// bus_rate: throughput of a bus in segments.
#pragma once

#include "splinefeed/hal/modbus/pvt/modbus_bus.hpp"

namespace splinefeed::hal::modbus {

/// Shortest segment duration for which the bus can serve all its drives, with a margin for repeated exchanges. Computed
/// from full blocks at the line's rate, plus the response time of the drives, which is measured now by status reads.
/// [us]
/// @pre the drives are open, the bus is not started
[[nodiscard]] double least_segment_us(ModbusBus& bus, const LinkTiming& timing) noexcept;

} // namespace splinefeed::hal::modbus
