// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/pvt_group_stop.hpp"

#include <algorithm>

namespace splinefeed::hal::modbus {

void PvtGroupStop::request(StopRequest request, std::uint64_t now_us, std::uint64_t hold_at_us) noexcept {
    hold_at_us_ = sequence_.requested() ? hold_at_us_ : hold_at_us;
    sequence_.request(request, now_us);
}

// Whether all drives stand at one place of the path: all slowed down from one instant on, or none moved; at the end of
// the motion it does not matter how.
bool PvtGroupStop::on_path(std::span<const PortDrive> drives) const noexcept {
    std::uint32_t least = drives.front().status().executed;
    std::uint32_t most = least;
    bool at_end = true;
    bool in_time = true;
    bool at_rest = true;
    for (std::size_t i = 0; i < drives.size(); ++i) {
        const std::uint32_t executed = drives[i].status().executed;
        least = std::min(least, executed);
        most = std::max(most, executed);
        at_end = at_end && drives[i].executed_all();
        in_time = in_time && stops_[i].hold() == PvtStop::Hold::in_time;
        at_rest = at_rest && stops_[i].hold() == PvtStop::Hold::at_rest;
    }
    return at_end || (most - least <= 1 && (in_time || at_rest));
}

void PvtGroupStop::follow(std::uint64_t now_us, std::span<const PortDrive> drives) noexcept {
    for (std::size_t i = 0; i < drives.size(); ++i) {
        stops_[i].see(drives[i].seen());
        facts_[i] = stops_[i].facts();
    }
    const bool together = on_path(drives);
    for (StopFacts& facts : facts_) {
        facts.on_path = together;
    }
    sequence_.update(now_us, facts_);
    for (std::size_t i = 0; i < drives.size(); ++i) {
        if (const StopRequest request = sequence_.to_send(i); request != StopRequest::none) {
            stops_[i].tell(request, hold_at_us_);
        }
    }
}

} // namespace splinefeed::hal::modbus
