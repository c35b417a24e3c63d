// SPDX-License-Identifier: MIT
// What the board says of itself: a serial port. USB 2.0, 9.6, with interface associations; CDC 1.2; PSTN 1.2, 5.3.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace rp2040 {

// clang-format off
/// Raspberry Pi's numbers for the RP2040: firmware without a driver of its own is asked to take 000a, and to be told
/// apart by its strings (https://github.com/raspberrypi/usb-pid). 1209:0001 of pid.codes may not be handed on.
constexpr std::array<std::uint8_t, 18> device_descriptor{
    18, 1, 0x00, 0x02, 0xef, 2, 1, 64,            // USB 2.0; interfaces are associated; packets of 64 bytes
    0x8a, 0x2e, 0x0a, 0x00, 0x00, 1, 1, 2, 3, 1}; // 2e8a:000a, version 1.00; three strings; one configuration

constexpr std::array<std::uint8_t, 75> configuration_descriptor{
    9, 2, 75, 0, 2, 1, 0, 0x80, 50, // two interfaces; powered by the bus, 100 mA
    8, 11, 0, 2, 2, 2, 0, 0,        // both are one function: CDC, ACM
    9, 4, 0, 0, 1, 2, 2, 0, 0,      // interface 0: CDC, ACM; without AT commands, so nobody looks for a modem
    5, 0x24, 0, 0x20, 0x01,         // CDC 1.2
    5, 0x24, 1, 0, 1,               // no calls
    4, 0x24, 2, 2,                  // line coding and line state
    5, 0x24, 6, 0, 1,               // interface 0 controls interface 1
    7, 5, 0x81, 3, 16, 0, 16,       // notifications, of which there are none: interrupt, 16 bytes, each 16 ms
    9, 4, 1, 0, 2, 10, 0, 0, 0,     // interface 1: CDC data
    7, 5, 0x02, 2, 64, 0, 0,        // bulk, 64 bytes
    7, 5, 0x82, 2, 64, 0, 0};
// clang-format on

constexpr std::array<std::uint8_t, 4> languages{4, 3, 0x09, 0x04}; // English
template <std::size_t size>
consteval auto string_descriptor(const char (&text)[size]) { // NOLINT(modernize-avoid-c-arrays)
    std::array<std::uint8_t, 2 * size> out{2 * size, 3};     // UTF-16
    for (std::size_t i = 0; i + 1 < size; ++i) {
        out[2 + 2 * i] = static_cast<std::uint8_t>(text[i]);
    }
    return out;
}
constexpr auto manufacturer = string_descriptor("splinefeed");
constexpr auto product = string_descriptor("splinefeed motion control board");
/// Fixed, so Windows keeps the port's name in whichever socket the cable is. The chip has no number; that of its flash
/// costs a time in which no code can be fetched from there. Of two boards at one computer one needs another number.
constexpr auto serial_number = string_descriptor("1");

/// @param name  kind and, below it, index  @return nothing: there is none
constexpr std::span<const std::uint8_t> usb_descriptor(std::uint32_t name) noexcept {
    constexpr std::array<std::span<const std::uint8_t>, 4> strings{languages, manufacturer, product, serial_number};
    return name == 0x0100                   ? device_descriptor
           : name == 0x0200                 ? configuration_descriptor
           : name - 0x0300 < strings.size() ? strings[name - 0x0300]
                                            : std::span<const std::uint8_t>();
}

} // namespace rp2040
