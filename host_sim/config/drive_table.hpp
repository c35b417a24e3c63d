// SPDX-License-Identifier: MIT
// DriveTable: the drives of a run: where each is, what it speaks, and which of the machine's axes it has.
#pragma once

#include "host_sim/config/machine_description.hpp"
#include "host_sim/config/target_address.hpp"

#include "splinefeed/hal/modbus/profile/drive_profile.hpp"

#include <string>
#include <vector>

namespace splinefeed::host {

struct DriveTable {
    struct Drive {
        TargetAddress address;
        hal::modbus::DriveProfile profile;
        std::vector<int> machine_axis; ///< of each of its axes; -1: none
    };
    std::vector<Drive> drives; ///< they all have the map splinefeed-pvt, or none of them
    bool interpolate = false;  ///< they have it
};

/// The addresses of a target, each with the machine's axes that are there; what an address leaves open is as its
/// profile has it. Throws UsageError and InputError.
[[nodiscard]] DriveTable drive_table(const std::string& target, const MachineDescription& machine);

} // namespace splinefeed::host
