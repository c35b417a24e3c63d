// SPDX-License-Identifier: MIT
// doubtful_numbers: numbers of a machine file that look like those of another unit.
#pragma once

#include "host_sim/config/machine_description.hpp"

#include <string>
#include <vector>

namespace splinefeed::host {

/// A sentence for each number of a linear axis or of the path that few machines have: "max_velocity_mm_s of x is 8000:
/// is that mm/min? Then it is 133.333333". Empty: there is none.
[[nodiscard]] std::vector<std::string> doubtful_numbers(const MachineDescription& machine);

} // namespace splinefeed::host
