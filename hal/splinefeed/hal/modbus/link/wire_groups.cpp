// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/link/wire_groups.hpp"

#include <algorithm>

namespace splinefeed::hal::modbus {

WireGroups group_by_wire(const std::vector<WireUse>& drives, const LinkTiming& base) {
    WireGroups groups;
    for (const WireUse& drive : drives) {
        auto wire = std::find_if(groups.wires.begin(), groups.wires.end(),
                                 [&](const WireUse& known) { return known.link.same_wire(drive.link); });
        if (wire == groups.wires.end()) {
            wire = groups.wires.insert(wire, {drive.link, base});
        }
        wire->timing = wire->timing.slower(drive.timing);
        groups.of_drive.push_back(static_cast<std::size_t>(wire - groups.wires.begin()));
    }
    return groups;
}

} // namespace splinefeed::hal::modbus
