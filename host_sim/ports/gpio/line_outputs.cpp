// SPDX-License-Identifier: MIT
#include "host_sim/ports/gpio/line_outputs.hpp"

#include "host_sim/ports/gpio/gpio_switches.hpp"
#include "host_sim/ports/gpio/line_inputs.hpp"
#include "host_sim/ports/gpio/line_spindle.hpp"

namespace splinefeed::host {

OutputParts make_line_outputs(const MachineDescription& machine) {
    if (machine.lines.empty()) {
        return {};
    }
    const ProgramChips chips = open_program_chips(machine.lines);
    OutputParts out;
    if (machine.spindle && machine.spindle->lines) {
        out.spindle = std::make_unique<LineSpindle>(*machine.spindle->lines, machine.lines,
                                                    machine.spindle->at_speed_timeout_s, chips);
    }
    out.switches = std::make_unique<GpioSwitches>(machine.lines, chips);
    out.inputs = std::make_unique<LineInputs>(machine.lines, chips);
    return out;
}

} // namespace splinefeed::host
