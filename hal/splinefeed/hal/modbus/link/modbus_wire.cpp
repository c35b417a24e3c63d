// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/link/modbus_wire.hpp"

#include "splinefeed/hal/modbus/link/modbus_link.hpp"

#include <array>

namespace splinefeed::hal::modbus {

namespace {

constexpr LinkAnswer no_function{.fault = LinkFault::exception, .exception = 1};

} // namespace

const char* describe(LinkFault fault, Wire wire) noexcept {
    switch (fault) {
    case LinkFault::none: return "it answers";
    case LinkFault::timeout:
        return wire == Wire::tcp ? "no answer in time; check power, cable and unit number"
                                 : "no answer in time; check power, unit number, baud rate and parity, and whether the "
                                   "wires A and B are swapped";
    case LinkFault::disconnected: return "the connection is lost; check the cable, and whether the port is open";
    case LinkFault::corrupt: return "an answer with a wrong checksum; look for noise, termination and the baud rate";
    case LinkFault::wrong_unit: return "another unit answered; two drives may have the same number";
    case LinkFault::wrong_length: return "an answer that does not fit the request; another master may be on the line";
    case LinkFault::exception: return "the drive refused the request";
    case LinkFault::bad_unit: return "nothing was sent: a unit number must be 1 to 247, or on tcp 255";
    }
    return "";
}

std::string describe(const LinkAnswer& answer, const ModbusWire& wire) {
    if (answer.fault == LinkFault::exception) {
        return std::string("exception ") + exception_name(answer.exception);
    }
    return answer.fault == LinkFault::disconnected && !wire.connected() ? "there is no connection: " + wire.error()
                                                                        : describe(answer.fault, wire.address().wire);
}

bool LinkAnswer::refused() const noexcept {
    constexpr std::uint8_t acknowledge = 5;
    constexpr std::uint8_t busy = 6;
    constexpr std::uint8_t gateway_path = 10;
    constexpr std::uint8_t gateway_target = 11;
    return fault == LinkFault::exception && exception != acknowledge && exception != busy &&
           exception != gateway_path && exception != gateway_target;
}

const char* exception_name(std::uint8_t code) noexcept {
    constexpr std::array<const char*, 12> names{
        "none", "illegal function",     "illegal address", "illegal value",         "device failure", "acknowledge",
        "busy", "negative acknowledge", "memory parity",   "not a known exception", "gateway path",   "gateway target"};
    return code < names.size() ? names[code] : names[9];
}

LinkAnswer ModbusWire::read_inputs(int /*unit*/, int /*address*/, std::span<std::uint16_t> /*out*/) noexcept {
    return no_function;
}

LinkAnswer ModbusWire::read_bit(int /*unit*/, BitTable /*table*/, int /*address*/, bool& /*out*/) noexcept {
    return no_function;
}

LinkAnswer ModbusWire::write_coil(int /*unit*/, int /*address*/, bool /*on*/) noexcept {
    return no_function;
}

std::unique_ptr<ModbusWire> make_link(const LinkAddress& address, const LinkTiming& timing, Clock& clock) {
    return std::make_unique<ModbusLink>(address, timing, clock);
}

} // namespace splinefeed::hal::modbus
