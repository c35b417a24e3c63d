// SPDX-License-Identifier: MIT
// PathTolerances: how far the path of a program may be from its lines and arcs, where the program does not say it.
#pragma once

#include "splinefeed/s3_feed_plan/limits/machine_settings.hpp"

#include <algorithm>
#include <limits>

namespace splinefeed::host {

/// Corners that are stops, as SharpestBlend of the core.
struct SharpestCorner {
    double curvature_1_mm = 0.0;
    double fading = 0.0;
    double half_sine = 0.0;
};

/// Keys of [path] in a machine file, in mm and degrees.
struct PathTolerances {
    double joint_mm = 0.001;     ///< of exact paths, where they turn by less than a degree or the curvature jumps
    double programmed_mm = 0.01; ///< elements that state no tolerance
    double rapid_mm = 0.1;       ///< rapids
    double rotary_deg = 100.0;   ///< of rotary axes, where a move's own number is larger
    SharpestCorner sharpest{};   ///< no key: of the planner
    bool jerk_limited = false;   ///< no key: of the machine; jumps of the curvature cost time then
    PerAxis<bool> rotary{};      ///< no key: of the machine
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

/// The acceleration across the path, v^2 kappa, that a machine allows whatever its axes do.
[[nodiscard]] inline double bent_acceleration(const MachineSettings& machine) {
    double least = std::numeric_limits<double>::infinity();
    if (machine.centripetal_mm_s2 > 0.0) {
        least = machine.centripetal_mm_s2;
    }
    if (machine.chord_error_mm > 0.0) {
        const double period_s = machine.sample_period_us * 1e-6;
        least = std::min(least, 8.0 * machine.chord_error_mm / (period_s * period_s));
    }
    return least;
}

/// The corners that a planner passes more slowly than a stop (bench/tolerance.py; corners of 1 to 170 degrees between
/// lines of 1 to 40 mm). Without a jerk limit a blend is faster, but for a centripetal limit C, or a chord error, that
/// is well below the acceleration A. The blend then loses where v^2 = C / kappa is far below the feed, and where
/// sin(phi/2) is above 1.5 C / A: both times are those of A on the same way. (By integrating v^2 along corners of 10 to
/// 150 degrees at C, with feeds of 0.7 to 3 times the root of A and the way: 1.4 to 1.8.) With a jerk limit it loses at
/// turns below 105 degrees, where the blend allows less than (1 - 1.6 sin^2(phi/2)) A^2 / (2 J).
[[nodiscard]] inline SharpestCorner sharpest_corner(const MachineSettings& machine) {
    double jerk = 0.0;
    double acceleration = machine.axis[0].max_acceleration_mm_s2;
    for (const unsigned k : indices(machine.axes)) {
        const AxisSettings& axis = machine.axis[k];
        if (axis.max_jerk_mm_s3 > 0.0) {
            jerk = jerk > 0.0 ? std::min(jerk, axis.max_jerk_mm_s3) : axis.max_jerk_mm_s3;
        }
        acceleration = std::min(acceleration, axis.max_acceleration_mm_s2);
    }
    const double half_feed = machine.max_feed_mm_s / 2.0;
    if (!(jerk > 0.0)) {
        const double bent = bent_acceleration(machine);
        return bent < acceleration ? SharpestCorner{bent / (half_feed * half_feed), 0.0, 1.5 * bent / acceleration}
                                   : SharpestCorner{};
    }
    const double slow = std::min(half_feed, acceleration * acceleration / (2.0 * jerk));
    return {acceleration / (slow * slow), 1.6};
}

} // namespace splinefeed::host
