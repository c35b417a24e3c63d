// SPDX-License-Identifier: MIT
// spine: a curve along which sections are carried, in frames that do not rotate about it.
#pragma once

#include "host_sim/curve/methods/description.hpp"

#include <vector>

namespace splinefeed::host {

/// A frame at a point of a curve: three orthogonal unit vectors, tangent = normal x binormal.
struct Frame {
    PerAxis<double> origin{};
    PerAxis<double> normal{};
    PerAxis<double> binormal{};
    PerAxis<double> tangent{};
};

/// Rotation-minimizing frames by double reflection: W. Wang, B. Juettler, D. Zheng, Y. Liu, "Computation of rotation
/// minimizing frames" (2008), fourth order in the spacing of the points. The first normal is given. @pre origins and
/// tangents (unit vectors) of the frames are set, successive origins differ
void turn_least(std::vector<Frame>& frames);

/// Moves the sections to their places along input["spine"]; does nothing if there is no spine. The spine is {"points":
/// [[x, y, z], ...], "stations": [one number per section, 0 to 1, increasing; evenly spaced if absent], "normal": [x,
/// y, z] (the direction of the sections' first coordinate at the start of the spine; if absent the axis that is most
/// perpendicular to it)}: a B-spline of degree 3 through the points, by chord length. A point (x, y) or (x, y, z) of a
/// section becomes origin + x normal + y binormal + z tangent. Throws DescriptionError.
void carry_along_spine(const nlohmann::json& input, std::vector<PointList>& sections);

} // namespace splinefeed::host
