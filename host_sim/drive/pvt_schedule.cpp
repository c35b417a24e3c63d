// SPDX-License-Identifier: MIT
#include "host_sim/drive/pvt_schedule.hpp"

#include "splinefeed/base/units.hpp"

#include <algorithm>

namespace splinefeed::host {

bool PvtSchedule::take(std::optional<std::uint64_t>& event_us, std::uint64_t now_us) noexcept {
    const bool due = event_us && *event_us <= now_us;
    if (due) {
        event_us.reset();
    }
    return due;
}

bool PvtSchedule::starves(std::uint64_t now_us, std::uint16_t watchdog_ms) const noexcept {
    return watchdog_ms != 0 && now_us - fed_us_ >= watchdog_ms * us_per_ms;
}

std::uint64_t PvtSchedule::next_us(std::uint64_t now_us, std::uint16_t watchdog_ms,
                                   std::uint64_t limit_us) const noexcept {
    for (const auto& event_us : {start_us_, hold_us_, std::optional(fed_us_ + watchdog_ms * us_per_ms)}) {
        if (event_us && *event_us > now_us) {
            limit_us = std::min(limit_us, *event_us);
        }
    }
    return limit_us;
}

} // namespace splinefeed::host
