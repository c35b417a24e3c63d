// SPDX-License-Identifier: MIT
// require_own_wire: spindles and modules are not on the wire of a drive, whose thread would have to wait for them.
#pragma once

#include "host_sim/config/machine_description.hpp"

#include <string>

namespace splinefeed::host {

/// Throws UsageError if a drive of the run is on the device's wire. @param what  the device, for the message: "the
/// spindle"   @param target  of the run
void require_own_wire(const DriveAddress& device, const std::string& what, const MachineDescription& machine,
                      const std::string& target);

} // namespace splinefeed::host
