// SPDX-License-Identifier: MIT
// spine: a curve that sections are carried along, in frames that do not turn about it.
#pragma once

#include "host_sim/curve/methods/description.hpp"

#include <vector>

namespace splinefeed::host {

/// A frame at a point of a curve: three unit vectors at right angles, tangent = normal x binormal.
struct Frame {
    PerAxis<double> origin{};
    PerAxis<double> normal{};
    PerAxis<double> binormal{};
    PerAxis<double> tangent{};
};

/// Rotation-minimizing frames by double reflection: W. Wang, B. Juettler, D. Zheng, Y. Liu, "Computation of rotation
/// minimizing frames" (2008), fourth order in the spacing of the points. The frames keep `first.normal` as well as they
/// can. @pre origins and tangents (unit vectors) of the frames are set, successive origins differ
void turn_least(std::vector<Frame>& frames);

/// Moves the sections to where input["spine"] carries them; nothing where there is no spine. The spine is
/// {"points": [[x, y, z], ...], "stations": [one number a section, 0 to 1, rising; evenly spread if absent],
/// "normal": [x, y, z] (where the sections' first coordinate points at its start; if absent the axis that is most
/// across)}: a B-spline of degree 3 through the points, by chord length. A point (x, y) or (x, y, z) of a section
/// becomes origin + x normal + y binormal + z tangent. Throws DescriptionError.
void carry_along_spine(const nlohmann::json& input, std::vector<PointList>& sections);

} // namespace splinefeed::host
