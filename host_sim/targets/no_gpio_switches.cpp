// SPDX-License-Identifier: MIT
// In place of gpio_switches.cpp where libgpiod is not installed.
#include "host_sim/base/input_error.hpp"
#include "host_sim/target/gpio/gpio_switches.hpp"

namespace splinefeed::host {

std::unique_ptr<RunSwitches> make_gpio_switches(const MachineDescription& machine) {
    if (!machine.lines.empty()) {
        throw UsageError(machine.file + ": its lines of coolant and outputs need libgpiod, which this splinefeed was "
                                        "built without; install it (Debian: libgpiod-dev) and build again");
    }
    return nullptr;
}

} // namespace splinefeed::host
