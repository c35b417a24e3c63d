// SPDX-License-Identifier: MIT
// PathTolerances: how far the path of a program may be from its lines and arcs, where the program does not say it.
#pragma once

namespace splinefeed::host {

/// Keys of [path] in a machine file, in mm.
struct PathTolerances {
    double joint_mm = 0.001;     ///< where only the curvature jumps, for machines with a jerk limit
    double programmed_mm = 0.01; ///< elements that state no tolerance
    double rapid_mm = 0.1;       ///< rapids
};

/// The largest that a program or a machine file may state.
inline constexpr double largest_tolerance_mm = 100.0;

/// A tolerance as machine files name it.
struct PathToleranceKey {
    const char* key;
    double PathTolerances::*value;
    double high; ///< the range is 0 to this [mm]
};
inline constexpr PathToleranceKey path_tolerance_keys[] = {
    {"joint_tolerance_mm", &PathTolerances::joint_mm, 1.0},
    {"default_tolerance_mm", &PathTolerances::programmed_mm, largest_tolerance_mm},
    {"rapid_tolerance_mm", &PathTolerances::rapid_mm, largest_tolerance_mm},
};

} // namespace splinefeed::host
