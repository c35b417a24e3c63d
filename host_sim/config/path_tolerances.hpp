// SPDX-License-Identifier: MIT
// PathTolerances: how far the path of a program may be from its lines and arcs, where the program does not say it.
#pragma once

#include "splinefeed/s3_feed_plan/limits/machine_path_rules.hpp"

namespace splinefeed::host {

/// Keys of [path] in a machine file, in mm and degrees.
struct PathTolerances {
    double joint_mm = 0.001;     ///< of exact paths, where they turn by less than a degree or the curvature jumps
    double programmed_mm = 0.01; ///< elements that state no tolerance
    double rapid_mm = 0.1;
    double rotary_deg = 100.0;                               ///< of rotary axes, where a move's own number is larger
    PerAxis<bool> rotary{};                                  ///< no key: of the machine
    PathRules<double> rules = path_rules(MachineSettings{}); ///< no key: of the machine
};

/// The largest that a program or a machine file may state.
inline constexpr double largest_tolerance_mm = 100.0;

/// A tolerance as machine files name it.
struct PathToleranceKey {
    const char* key;
    double PathTolerances::*value;
    double high; ///< the range is 0 to this
    const char* unit;
};
inline constexpr PathToleranceKey path_tolerance_keys[] = {
    {"joint_tolerance_mm", &PathTolerances::joint_mm, 1.0, "mm"},
    {"default_tolerance_mm", &PathTolerances::programmed_mm, largest_tolerance_mm, "mm"},
    {"rapid_tolerance_mm", &PathTolerances::rapid_mm, largest_tolerance_mm, "mm"},
    {"rotary_tolerance_deg", &PathTolerances::rotary_deg, largest_tolerance_mm, "degrees"},
};

} // namespace splinefeed::host
