// SPDX-License-Identifier: MIT
// ListenAddress: the address of a simulated drive.
#pragma once

#include <string>
#include <string_view>

namespace splinefeed::host {

struct ListenAddress {
    enum class Kind { tcp, rtu };

    Kind kind = Kind::tcp;
    std::string host = "127.0.0.1"; ///< IPv4 in numbers
    int port = 0;                   ///< 0: any free port
    std::string device;             ///< of a serial line
    int baud = 115200;
    char parity = 'E';
    int stop_bits = 0; ///< 1, 2, or 0: as the standard says: 2 without parity, otherwise 1
    int unit = 1;      ///< over TCP it answers to 0 and 255, too: the device at the address
    bool pace = true;  ///< of a serial line: replies take the time that they would take at that rate

    /// The address as text, with the default values written out, except stop bits and pace.
    [[nodiscard]] std::string text() const;
    [[nodiscard]] int stops() const noexcept { return stop_bits != 0 ? stop_bits : parity == 'N' ? 2 : 1; }
    /// Time of a character on the line, including start, parity and stop bits.
    [[nodiscard]] double character_us() const noexcept;
};

/// Reads tcp://HOST:PORT?unit=1 or rtu:///dev/ttyUSB0?baud=115200&parity=N&unit=1. Addresses outside this computer are
/// only accepted with allow_remote. Throws UsageError.
[[nodiscard]] ListenAddress parse_listen_address(std::string_view text, bool allow_remote);

} // namespace splinefeed::host
