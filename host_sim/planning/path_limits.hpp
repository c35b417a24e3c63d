// SPDX-License-Identifier: MIT
// PathLimits: where the axes may be, checked on the curve before it is travelled.
#pragma once

#include "host_sim/config/machine_description.hpp"

#include "splinefeed/s1_curve/curve_segment.hpp"

#include <optional>
#include <string>

namespace splinefeed::host {

/// The travel of each axis and the range of its counter. Bezier curves lie in the hull of their control points: a
/// segment whose hull is inside costs one comparison a point; another one is halved until it is decided, to 1 nm
/// (splines/curve_hull.hpp). Nothing is sampled.
class PathLimits {
public:
    explicit PathLimits(const MachineDescription& machine);

    /// What is wrong with the segment, as a sentence, if it leaves the limits.
    template <Scalar S>
    [[nodiscard]] std::optional<std::string> violation(const CurveSegment<S>& segment) const;

private:
    struct Axis {
        std::string name;
        const char* unit = "mm";
        double low = 0.0; ///< of what is allowed [mm]
        double high = 0.0;
        bool travel = false; ///< from the machine file; else from the range of counts
    };
    int axes_;
    PerAxis<Axis> axis_{};
};

} // namespace splinefeed::host
