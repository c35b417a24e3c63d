// SPDX-License-Identifier: MIT
// baud_rate: the rates of a serial line.
#pragma once

#include <algorithm>
#include <array>

namespace splinefeed::host {

/// Rates for which systems have names; for any other rate libmodbus silently uses 9600. [baud], ascending
inline constexpr std::array<int, 10> baud_rates{1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200, 230400, 460800};

[[nodiscard]] constexpr bool is_baud_rate(int baud) noexcept {
    return std::ranges::find(baud_rates, baud) != baud_rates.end();
}

} // namespace splinefeed::host
