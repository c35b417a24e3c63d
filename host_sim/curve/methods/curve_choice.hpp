// SPDX-License-Identifier: MIT
// CurveChoice: which curve goes through the points, and how: what the user asked for, checked against the method.
#pragma once

#include "splinefeed/splines/bezier_piece.hpp"
#include "splinefeed/splines/parameterization.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace splinefeed::host {

/// A tangent at an end of the curve. g2 and g2-bezier take it in units of the end chord, ferguson and
/// bspline-interpolation as the derivative itself.
struct Tangent {
    int components = 0;
    PerAxis<double> value{};
};

struct CurveChoice {
    std::string_view method = "g2"; ///< its name; bezier: as a curve file has it
    bool closed = false;
    bool smooth = false; ///< promote a C1 chain to G2
    int degree = 3;
    Parameterization parameterization = Parameterization::chordal;
    std::optional<std::string> knots; ///< bspline-interpolation: uniform or averaged
    double tension = 0.5;
    bool constant_factor = false; ///< catmull-rom-modified: one factor for all segments, not one times its chord
    std::optional<double> beta1;  ///< nothing: the ratio of the chords
    double beta2 = 0.0;
    double lambda = 1.0;
    std::optional<double> mu;              ///< nothing: automatic
    std::optional<int> curvature_sign = 1; ///< nothing: automatic
    double corner_angle_deg = 60.0;
    double tolerance_mm = 0.0; ///< polyline: how far the path may be from the lines; 0: exact
    std::optional<Tangent> start_tangent;
    std::optional<Tangent> end_tangent;
};

} // namespace splinefeed::host
