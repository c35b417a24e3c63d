// SPDX-License-Identifier: MIT
// CurveMethod: a method that --curve may name, and what it may be told.
#pragma once

#include "splinefeed/splines/parameterization.hpp"

#include <string_view>

namespace splinefeed::host {

/// What a method may be told.
enum CurveOption : unsigned {
    takes_nothing = 0U,
    takes_parameterization = 1U,
    takes_tension = 1U << 1U,
    takes_factor = 1U << 2U,
    takes_corners = 1U << 3U,
    takes_tangents = 1U << 4U,
    takes_degree = 1U << 5U,
    takes_knots = 1U << 6U,
    takes_betas = 1U << 7U,
    takes_joints = 1U << 8U, ///< lambda, mu, curvature sign
    takes_smooth = 1U << 9U,
    takes_tolerance = 1U << 10U,
};

struct CurveMethod {
    std::string_view name;
    unsigned takes = takes_nothing; ///< CurveOptions
    Parameterization usual = Parameterization::chordal;
    double usual_tension = 0.5;
    double highest_tension = 10.0;
    double lowest_beta2 = 0.0;
    int lowest_degree = 3;
    int highest_degree = 3;
    double usual_corner_angle_deg = 60.0;
    bool passes_waypoints = true; ///< else they are control points, and how far it stays from them says nothing
};

} // namespace splinefeed::host
