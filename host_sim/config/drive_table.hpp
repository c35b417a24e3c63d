// SPDX-License-Identifier: MIT
// DriveTable: the drives of a run: their addresses, their profiles, and the machine axes of each.
#pragma once

#include "host_sim/config/drive_address.hpp"
#include "host_sim/config/machine_description.hpp"

#include "splinefeed/hal/modbus/profile/drive_profile.hpp"

#include <string>
#include <vector>

namespace splinefeed::host {

struct DriveTable {
    struct Drive {
        DriveAddress address;
        hal::modbus::DriveProfile profile;
        std::vector<int> machine_axis;       ///< machine axis of each of its axes; -1: none
        std::vector<std::string> axis_names; ///< likewise: "axis y", or "its axis 2", which the machine does not use
        std::string place;                   ///< where it is named, for messages: "m.toml:12: "; empty: in --target
        std::string name;                    ///< "drive of y (modbus-tcp://...)"; of --target its address
    };
    std::vector<Drive> drives; ///< all of them use the map splinefeed-pvt, or none does
    bool interpolate = false;  ///< they use it
};

/// Values that an address does not state become those of the profile. Throws AddressError if they do not fit together.
void complete_address(DriveAddress& address, const hal::modbus::DriveProfile& profile);

/// The drives of a target, each with its machine axes. Values that an address does not state come from the profile.
/// Throws UsageError and InputError.
[[nodiscard]] DriveTable drive_table(const std::string& target, const MachineDescription& machine);

} // namespace splinefeed::host
