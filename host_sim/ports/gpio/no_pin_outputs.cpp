// SPDX-License-Identifier: MIT
// In place of pin_outputs.cpp where libgpiod is not installed.
#include "host_sim/base/input_error.hpp"
#include "host_sim/ports/gpio/pin_outputs.hpp"

namespace splinefeed::host {

OutputParts make_pin_outputs(const MachineDescription& machine) {
    if (!machine.lines.empty()) {
        throw UsageError(machine.file +
                         ": its lines of spindle, coolant, outputs and inputs need libgpiod, which this splinefeed "
                         "was built without; install it (Debian: libgpiod-dev) and build again");
    }
    return {};
}

} // namespace splinefeed::host
