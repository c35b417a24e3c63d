// SPDX-License-Identifier: MIT
// ZeroRange: where the zero of a program (G54) may lie so that its moves stay within the travel of a machine.
#pragma once

#include "host_sim/run/run_machine.hpp"

#include <string>
#include <vector>

namespace splinefeed::host {

/// Of one axis; in the machine's coordinates. [mm, degrees]
struct ZeroRange {
    std::string axis;
    double now = 0.0;             ///< where the zero lies
    std::optional<Travel> zero{}; ///< where it may lie; nothing: anywhere. `low` above `high`: nowhere
    double length = 0.0;          ///< of the program
    double travel = 0.0;          ///< of the machine
};

/// For each axis. Empty: the program leaves the travel in the machine's own coordinates (G53, G28, steps of G91), or
/// its moves depend on where the zero is. It is read twice, side by side, with two zeros: what moves as they do is the
/// program's. @pre it can be read again
[[nodiscard]] std::vector<ZeroRange> zero_ranges(const PathArguments& arguments, const RunMachine& of,
                                                 const MachineState& begins);

/// Whether the program leaves the travel because of where its zero lies.
[[nodiscard]] bool leaves(const std::vector<ZeroRange>& ranges) noexcept;
/// Whether it stays within where its zero is moved.
[[nodiscard]] bool can_fit(const std::vector<ZeroRange>& ranges) noexcept;

/// "the program fits if the part's zero lies within X -780..-60, Y -790..-60: add --zero=-420,-425,0", or which axis is
/// shorter than the program. Empty: of no ranges.
[[nodiscard]] std::string zero_advice(const std::vector<ZeroRange>& ranges);

} // namespace splinefeed::host
