// SPDX-License-Identifier: MIT
// OpenReads: readings on a serial line that were not answered in time: their answers may still come.
#pragma once

#include "splinefeed/hal/modbus/link/link_address.hpp"

#include <array>

namespace splinefeed::hal::modbus {

/// An answer to a reading on a serial line does not say to which one. So a unit that owes one is not asked to read
/// again before the answer cannot come any more: `latest_us` after the time-out, or once the unit has answered another
/// request that was made since then, because a unit answers in order. An answer that comes later still is taken for
/// that of the next reading: drives do not take that long. For one thread; all instants are of one clock [us].
class OpenReads {
public:
    static constexpr std::uint64_t latest_us = 300'000; ///< an answer comes so long after the time-out, at most

    void missed(int unit, std::uint64_t now_us) noexcept { until_us_[index(unit)] = now_us + latest_us; }
    /// To a request whose answer no reading has.
    void answered(int unit) noexcept { until_us_[index(unit)] = 0; }
    /// From when on the unit may be asked to read.
    [[nodiscard]] std::uint64_t until_us(int unit) const noexcept { return until_us_[index(unit)]; }

private:
    [[nodiscard]] static std::size_t index(int unit) noexcept { return static_cast<std::size_t>(unit); }

    std::array<std::uint64_t, most_unit + 1> until_us_{};
};

} // namespace splinefeed::hal::modbus
