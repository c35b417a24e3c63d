// SPDX-License-Identifier: MIT
// CurveChoice: the curve method and its options, as the user chose them, checked against each other.
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
    // These need all points at once:
    bspline_interpolation,
    ferguson,
    beta_chain,
    bezier, ///< segments of a curve file
};

/// The name on the command line and in curve files.
[[nodiscard]] std::string_view method_name(Method method) noexcept;
/// Whether the curve of this name passes through its waypoints. Otherwise they are control points, and their distance
/// from the curve says nothing.
[[nodiscard]] constexpr bool passes_waypoints(std::string_view curve_name) noexcept {
    return curve_name != "bspline" && curve_name != "beta-chain";
}
/// Whether all points must be known before the curve can begin.
[[nodiscard]] constexpr bool needs_all_points(Method method) noexcept {
    return method >= Method::bspline_interpolation && method < Method::bezier;
}

/// The curve options of the command line as typed; no value: not given.
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

/// A tangent at an end of the curve. For g2 and g2-bezier it is in units of the end chord; for ferguson and
/// bspline-interpolation it is the derivative itself.
struct Tangent {
    int components = 0;
    PerAxis<double> value{};
};

struct CurveChoice {
    Method method = Method::g2;
    bool closed = false;
    bool smooth = false; ///< turn a C1 chain into a G2 curve
    int degree = 3;
    Parameterization parameterization = Parameterization::chordal;
    std::optional<std::string> knots; ///< bspline-interpolation: uniform or averaged
    double tension = 0.5;
    bool constant_factor = false; ///< catmull-rom-modified: one factor for all segments, instead of a factor times the
                                  ///< chord
    std::optional<double> beta1;  ///< nothing: the ratio of the chords
    double beta2 = 0.0;
    double lambda = 1.0;
    std::optional<double> mu;              ///< nothing: automatic
    std::optional<int> curvature_sign = 1; ///< nothing: automatic
    double corner_angle_deg = 60.0;
    std::optional<Tangent> start_tangent;
    std::optional<Tangent> end_tangent;
};

/// Reads the options and adds the defaults of the method: g2 chordal, catmull-rom centripetal with tension 1/2, corners
/// from 60 degrees (bspline: none). Throws UsageError if a value is wrong or the method has no such option.
[[nodiscard]] CurveChoice choose_curve(const CurveArguments& arguments);

/// The first option that was given, without its value; empty: none. For inputs that contain their own curve; --smooth
/// is allowed with these and is not counted.
[[nodiscard]] std::string_view first_option(const CurveArguments& arguments) noexcept;

} // namespace splinefeed::host
