// SPDX-License-Identifier: MIT
#include "host_sim/ports/modbus/own_wire.hpp"

#include "host_sim/base/input_error.hpp"

#include <fmt/format.h>

namespace splinefeed::host {

void require_own_wire(const DriveAddress& device, const std::string& what, const MachineDescription& machine,
                      const std::string& target) {
    const bool all = target == "modbus";
    if (!all && target.rfind("modbus-", 0) != 0) {
        return;
    }
    for (const unsigned k : indices(machine.settings.axes)) {
        const DriveAddress drive = parse_drive_address(all ? machine.drive[k] : target);
        if (drive.link.same_wire(device.link)) {
            throw UsageError(fmt::format("{}: {} shares the line of the drive of axis {}; give it a line, or a port, "
                                         "of its own",
                                         device.text, what, machine.axis_name[k]));
        }
    }
}

} // namespace splinefeed::host
