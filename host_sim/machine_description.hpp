// SPDX-License-Identifier: MIT
// MachineDescription: a machine file in memory.
#pragma once

#include "splinefeed/s3_feed_plan/motion_limits.hpp"

#include <optional>
#include <string>

namespace splinefeed::host {

/// Soft limits of an axis [mm].
struct Travel {
    double low = 0.0;
    double high = 0.0;
};

struct MachineDescription {
    std::string file; ///< where it was read, for messages; empty: the built-in default machine
    std::string name = "default machine";
    MachineSettings settings{};              ///< numbers, in the core's form
    PerAxis<std::string> axis_name{};        ///< "x", "y", ...
    PerAxis<std::optional<Travel>> travel{}; ///< soft limits where the file states them
};

} // namespace splinefeed::host
