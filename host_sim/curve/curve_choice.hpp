// SPDX-License-Identifier: MIT
// CurveChoice: which curve goes through the points, and how: what the user asked for, checked against the method.
#pragma once

#include "splinefeed/s1_curve/waypoint_curve.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace splinefeed::host {

enum class Method {
    g2,
    g2_bezier,
    catmull_rom,
    catmull_rom_modified,
    bspline,
    polyline,
    // These see all points at once:
    bspline_interpolation,
    ferguson,
    beta_chain,
    bezier, ///< as a curve file has it
};

/// As the command line and the curve files name it.
[[nodiscard]] std::string_view method_name(Method method) noexcept;
/// Whether the curve of that name passes its waypoints; else they are control points, and how far it stays from them
/// says nothing.
[[nodiscard]] constexpr bool passes_waypoints(std::string_view curve_name) noexcept {
    return curve_name != "bspline" && curve_name != "beta-chain";
}
/// Whether its points have to be known before it can begin.
[[nodiscard]] constexpr bool needs_all_points(Method method) noexcept {
    return method >= Method::bspline_interpolation && method < Method::bezier;
}

/// The curve options of the command line as they were typed; no value: not given.
struct CurveArguments {
    std::optional<std::string> method;
    std::optional<std::string> degree;
    std::optional<std::string> parameterization;
    std::optional<std::string> knots;
    std::optional<std::string> tension;
    std::optional<std::string> factor;
    std::optional<std::string> beta1;
    std::optional<std::string> beta2;
    std::optional<std::string> lambda;
    std::optional<std::string> mu;
    std::optional<std::string> curvature_sign;
    std::optional<std::string> corner_angle;
    std::optional<std::string> start_tangent;
    std::optional<std::string> end_tangent;
    bool closed = false;
    bool smooth = false;
};

/// A tangent at an end of the curve. g2 and g2-bezier take it in units of the end chord, ferguson and
/// bspline-interpolation as the derivative itself.
struct Tangent {
    int components = 0;
    PerAxis<double> value{};
};

struct CurveChoice {
    Method method = Method::g2;
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
    std::optional<Tangent> start_tangent;
    std::optional<Tangent> end_tangent;
};

/// Reads the options and fills in the method's defaults: g2 chordal, catmull-rom centripetal with tension 1/2, corners
/// from 60 degrees (bspline: none). Throws UsageError where a value is wrong or the method has no such option.
[[nodiscard]] CurveChoice choose_curve(const CurveArguments& arguments);

/// The option that was given first, without its value; empty: none was. For inputs that bring their own curve;
/// --smooth goes with these, too, and is not counted.
[[nodiscard]] std::string_view first_option(const CurveArguments& arguments) noexcept;

} // namespace splinefeed::host
