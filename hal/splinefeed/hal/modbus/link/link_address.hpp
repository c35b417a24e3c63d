// SPDX-License-Identifier: MIT
// LinkAddress: address of a drive on a Modbus line, and the duration of frames on that line.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

namespace splinefeed::hal::modbus {

enum class Wire : std::uint8_t { tcp, rtu };

struct LinkAddress {
    Wire wire = Wire::tcp;
    std::string host = "127.0.0.1"; ///< tcp: a name or an IPv4 address; rtu: the serial device
    int port = 502;
    int baud = 115200;
    char parity = 'E'; ///< 'N', 'E' or 'O'
    int stop_bits = 0; ///< 1 or 2; 0: as in the standard, two without parity, else one
    int unit = 1;      ///< 1 to 247; on tcp also 255: the device at the address

    [[nodiscard]] bool operator==(const LinkAddress&) const = default;
    [[nodiscard]] constexpr int stops() const noexcept { return stop_bits != 0 ? stop_bits : parity == 'N' ? 2 : 1; }
    /// Whether both are on the same wire; units may differ.
    [[nodiscard]] bool same_wire(const LinkAddress& other) const noexcept {
        return wire == other.wire && host == other.host && (wire == Wire::rtu || port == other.port);
    }
};

/// Timing of a line and its drives. [us]
struct LinkTiming {
    std::uint32_t answer_us = 50'000; ///< a drive answers within this time after the request has passed the line
    std::uint32_t before_us = 0;      ///< silence before a frame, in addition to the 3.5 characters of RTU
    int retries = 3;                  ///< after 1 + retries consecutive time-outs a tcp connection is replaced

    /// Timing that suits both of two drives on one wire.
    [[nodiscard]] constexpr LinkTiming slower(const LinkTiming& other) const noexcept {
        return {std::max(answer_us, other.answer_us), std::max(before_us, other.before_us),
                std::max(retries, other.retries)};
    }
};

inline constexpr int most_unit = 247;   ///< of a drive on a serial line
inline constexpr int single_unit = 255; ///< on tcp: the device at the address (MODBUS_TCP_SLAVE)

/// Whether the unit number is valid on that wire. 0 is a broadcast, which no drive answers.
[[nodiscard]] constexpr bool is_unit(Wire wire, int unit) noexcept {
    return (unit >= 1 && unit <= most_unit) || (wire == Wire::tcp && unit == single_unit);
}

/// Duration of a frame on a serial line: start bit, 8 data bits, parity and stop bits for each byte. tcp: 0. [us]
[[nodiscard]] constexpr std::uint32_t frame_us(const LinkAddress& address, std::size_t bytes) noexcept {
    const auto bits = static_cast<std::uint64_t>(1 + 8 + (address.parity == 'N' ? 0 : 1) + address.stops());
    return address.wire == Wire::tcp
               ? 0
               : static_cast<std::uint32_t>(bits * bytes * 1'000'000U / static_cast<std::uint64_t>(address.baud));
}

/// Silence between two frames: 3.5 characters, or 1750 us above 19200 baud (Modbus over serial line V1.02, 2.5.1.1).
/// [us]
[[nodiscard]] constexpr std::uint32_t silence_us(const LinkAddress& address) noexcept {
    constexpr int fixed_from = 19200;
    constexpr std::uint32_t fixed_us = 1750;
    constexpr std::uint32_t half_characters = 7;
    return address.wire == Wire::tcp   ? 0
           : address.baud > fixed_from ? fixed_us
                                       : frame_us(address, half_characters) / 2;
}

/// Lengths of the frames of an exchange: function 23, or 16 or 03 if one of the register counts is 0. [bytes]
struct ExchangeBytes {
    std::size_t request = 0;
    std::size_t reply = 0;
};

[[nodiscard]] constexpr ExchangeBytes exchange_bytes(const LinkAddress& address, std::size_t written,
                                                     std::size_t read) noexcept {
    const std::size_t frame = address.wire == Wire::rtu ? 3 : 7; // unit and CRC, or the header
    const std::size_t request = written == 0 ? 5 : read == 0 ? 6 + 2 * written : 10 + 2 * written;
    const std::size_t reply = read == 0 ? 5 : 2 + 2 * read;
    return {frame + request, frame + reply};
}

/// Duration of both frames and the silence before each. [us]
[[nodiscard]] constexpr std::uint32_t exchange_us(const LinkAddress& address, std::size_t written,
                                                  std::size_t read) noexcept {
    const ExchangeBytes bytes = exchange_bytes(address, written, read);
    return frame_us(address, bytes.request + bytes.reply) + 2 * silence_us(address);
}

} // namespace splinefeed::hal::modbus
