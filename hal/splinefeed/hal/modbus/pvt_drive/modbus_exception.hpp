// SPDX-License-Identifier: MIT
// ModbusException: how a drive answers a request that it does not execute.
#pragma once

#include <cstdint>

namespace splinefeed::hal::modbus {

/// Exception codes of the Modbus application protocol.
enum class ModbusException : std::uint8_t {
    none = 0,
    illegal_function = 1,
    illegal_address = 2,
    illegal_value = 3,
    device_failure = 4,
    acknowledge = 5,
    busy = 6,
    gateway_path = 10,
    gateway_target = 11,
};

} // namespace splinefeed::hal::modbus
