// SPDX-License-Identifier: MIT
#include "host_sim/target/run_target.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/target/pvt_target.hpp"
#include "host_sim/target/setpoint_target.hpp"

#ifdef SPLINEFEED_HAS_GPIO
#include "host_sim/target/gpio/gpio_target.hpp"
#endif

namespace splinefeed::host {

std::unique_ptr<RunTarget> make_run_target(const std::string& target, const MachineDescription& machine,
                                           const RunWishes& wishes) {
#ifdef SPLINEFEED_HAS_GPIO
    if (is_gpio_address(target)) {
        return make_gpio_target(parse_gpio_address(target), machine, wishes);
    }
#endif
    if (wishes.probe) {
        throw UsageError("--probe needs a probe: an input of a target gpio://");
    }
    DriveTable table = drive_table(target, machine);
    if (table.interpolate) {
        return std::make_unique<PvtTarget>(std::move(table), machine, wishes.home);
    }
    return std::make_unique<SetpointTarget>(std::move(table), machine, wishes.home);
}

} // namespace splinefeed::host
