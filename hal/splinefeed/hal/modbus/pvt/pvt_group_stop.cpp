// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/pvt/pvt_group_stop.hpp"

#include <algorithm>

namespace splinefeed::hal::modbus {

void PvtGroupStop::request(StopRequest request, std::uint64_t now_us) noexcept {
    waits_ = waits_ || !sequence_.requested();
    sequence_.request(request, now_us);
}

// Whether all drives stand at one point of the path: all slowed down from one instant on, or none moved and all are at
// the same joint, or all are at the end of the motion.
bool PvtGroupStop::on_path(std::span<const PortDrive> drives) const noexcept {
    const std::uint32_t first = drives.front().status().executed; // sequence numbers wrap
    std::int32_t least = 0;
    std::int32_t most = 0;
    bool stands = true;
    bool at_end = true;
    bool in_time = true;
    bool at_rest = true;
    for (std::size_t i = 0; i < drives.size(); ++i) {
        const auto executed = static_cast<std::int32_t>(drives[i].status().executed - first);
        least = std::min(least, executed);
        most = std::max(most, executed);
        at_end = at_end && drives[i].executed_all();
        in_time = in_time && stops_[i].hold() == PvtStop::Hold::in_time;
        at_rest = at_rest && stops_[i].hold() == PvtStop::Hold::at_rest && drives[i].at_joint();
        stands = stands && drives[i].last_report().problem == DriveProblem::none && drives[i].at_standstill();
    }
    return stands && (at_end || (at_rest && most == least) || (in_time && in_step_ && most - least <= 1));
}

bool PvtGroupStop::update(std::uint64_t now_us, std::span<const PortDrive> drives) noexcept {
    for (std::size_t i = 0; i < drives.size(); ++i) {
        stops_[i].update(drives[i].last_report(), times_);
        facts_[i] = stops_[i].facts();
    }
    const bool together = on_path(drives);
    for (StopFacts& facts : facts_) {
        facts.on_path = together;
    }
    const bool grew = sequence_.update(now_us, facts_);
    if (waits_) {
        hold_at_us_ = now_us + PortTimes::lead_us;
        in_step_ = std::all_of(drives.begin(), drives.end(), [](const PortDrive& drive) { return drive.in_step(); });
        // A start that is near may come before a drive is told of the hold: it would move, and the others stand.
        // So all begin, and are held behind it.
        waits_ = false;
        for (std::size_t i = 0; i < drives.size(); ++i) {
            waits_ = waits_ || (sequence_.to_send(i) == StopRequest::hold && drives[i].starts_about(now_us));
        }
    }
    if (waits_) {
        return grew;
    }
    for (std::size_t i = 0; i < drives.size(); ++i) {
        if (const StopRequest request = sequence_.to_send(i); request != StopRequest::none) {
            stops_[i].send_once(request, hold_at_us_);
        }
    }
    return grew;
}

} // namespace splinefeed::hal::modbus
