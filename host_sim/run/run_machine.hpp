// SPDX-License-Identifier: MIT
// RunMachine: the machine of a run, as the planning of its input takes it.
#pragma once

#include "host_sim/config/machine_choice.hpp"
#include "host_sim/config/state_file.hpp"
#include "host_sim/output/summary.hpp"
#include "host_sim/program/path_input.hpp"

#include <string>
#include <vector>

namespace splinefeed::host {

/// For a program in G-code the limit of the path is that of a rapid along the diagonal: rapids move at the limits of
/// the axes. What moves with a feed may not exceed is then a limit of each move.
struct RunMachine {
    /// As choose_machine(). Throws InputError and UsageError.
    RunMachine(const MachineChoice& choice, const InputFormat& format);
    /// Of a machine as a file states it. @param gcode  the input is a program in G-code
    RunMachine(MachineDescription stated, bool gcode);

    /// The machine as its file states it.
    [[nodiscard]] MachineDescription as_stated() const;

    /// Where the machine stands as far as it is told, and its offsets. Throws InputError and UsageError.
    /// @param state  a file; empty: none   @param position  "X,Y,Z"; empty: as the state says
    /// @param homed  it finds its references first: then it stands at 0, whatever the state says
    /// @param zero  "X,Y,Z": the origin of G54, which is active, without G92; empty: as the state says
    [[nodiscard]] MachineState state(const std::string& state, const std::string& position, bool homed = false,
                                     const std::string& zero = {}) const;
    /// For the summary. @param gcode  the program has a zero
    [[nodiscard]] std::vector<Summary::AxisPlace> places(const MachineState& begins, bool gcode) const;
    /// Whose state a run with that target keeps. @param target  "modbus", "gpio:///dev/gpiochip0?map=..."
    [[nodiscard]] StateOwner owner(const std::string& target) const {
        return {axes, machine.name, target.substr(0, target.find(':'))};
    }
    /// An axis of which nobody told anything stands at 0. Throws InputError where the state says that its place is not
    /// known.
    /// @param file  of the state, for messages
    void settle_places(MachineState& state, const std::string& file) const;

    /// As an input is planned for it; refers to this.
    [[nodiscard]] PathMachine path() const;

    MachineDescription machine;
    double max_feed_mm_s = 0.0; ///< as the file states it
    std::vector<std::string> axes;
};

} // namespace splinefeed::host
