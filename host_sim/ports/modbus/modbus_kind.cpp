// SPDX-License-Identifier: MIT
#include "host_sim/base/input_error.hpp"
#include "host_sim/config/drive_address.hpp"
#include "host_sim/ports/modbus/modbus_report.hpp"
#include "host_sim/ports/modbus/pvt_target.hpp"
#include "host_sim/ports/modbus/setpoint_target.hpp"
#include "host_sim/ports/target_table.hpp"

namespace splinefeed::host {

namespace {

bool is_modbus(const std::string& target) {
    return target == "modbus" || target.rfind("modbus-", 0) == 0;
}

void check_modbus(const std::string& target) {
    if (target != "modbus") {
        static_cast<void>(parse_drive_address(target));
    }
}

std::unique_ptr<RunTarget> make_modbus_target(const std::string& target, const MachineDescription& machine,
                                              const RunOptions& options) {
    if (options.probe) {
        throw UsageError("--probe needs a probe: an input of a target gpio://");
    }
    DriveTable table = drive_table(target, machine);
    if (table.interpolate) {
        return std::make_unique<PvtTarget>(std::move(table), machine, options);
    }
    return std::make_unique<SetpointTarget>(std::move(table), machine, options);
}

LinkReport modbus_link_report(const std::string& target, const MachineDescription& machine, bool any_machine,
                              double seconds) {
    return modbus_report(target, machine, any_machine, seconds);
}

} // namespace

extern const TargetKind modbus_kind{
    .names = "modbus, modbus-tcp://, modbus-rtu:// (docs/reference/modbus.md)",
    .help = "modbus: each axis's drive as the machine file names it; modbus-tcp://HOST:PORT?unit=1 or "
            "modbus-rtu:///dev/ttyUSB0?baud=115200: one drive with all axes",
    .is = is_modbus,
    .check = check_modbus,
    .make = make_modbus_target,
    .report = modbus_link_report,
};

} // namespace splinefeed::host
