// SPDX-License-Identifier: MIT
// RunMachine: the machine of a run, as the planning of its input takes it.
#pragma once

#include "host_sim/config/machine_description.hpp"
#include "host_sim/program/input_format.hpp"

#include <string>
#include <vector>

namespace splinefeed::host {

/// For a program in G-code the limit of the path is that of a rapid along the diagonal: rapids move at the limits of
/// the axes. What moves with a feed may not exceed is then a limit of each move.
struct RunMachine {
    /// Reads the file. Throws InputError.
    /// @param file  empty: the default machine
    RunMachine(const std::string& file, const InputFormat& format);

    MachineDescription machine;
    double max_feed_mm_s = 0.0; ///< as the file states it
    std::vector<std::string> axes;
    PathTolerances tolerances;
};

} // namespace splinefeed::host
