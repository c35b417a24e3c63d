// SPDX-License-Identifier: MIT
// PathLimits: checks that the curve keeps the travel of the axes, before it is travelled.
#pragma once

#include "host_sim/config/machine_description.hpp"

#include "splinefeed/s1_curve/curve_segment.hpp"

#include <optional>
#include <string>

namespace splinefeed::host {

/// Checks the travel of each axis and the range of its counter. Bezier curves lie in the hull of their control points:
/// a segment whose hull is inside costs one comparison per point; another segment is halved until the result is
/// certain, to 1 nm (splines/curve_hull.hpp). Nothing is sampled.
class PathLimits {
public:
    explicit PathLimits(const MachineDescription& machine);

    /// If the segment leaves the limits, one sentence that says where.
    [[nodiscard]] std::optional<std::string> violation(const CurveSegment<double>& segment) const;

    /// Whether the places from `low` to `high` of all axes are within, with a margin. [mm, degrees]
    [[nodiscard]] bool contain(const PerAxis<double>& low, const PerAxis<double>& high, double margin) const noexcept;

private:
    struct Axis {
        std::string name;
        const char* unit = "mm";
        double low = 0.0; ///< lower end of the allowed range [mm]
        double high = 0.0;
        bool travel = false; ///< true: the range is from the machine file; false: it is the range of counts
    };
    int axes_;
    PerAxis<Axis> axis_{};
};

} // namespace splinefeed::host
