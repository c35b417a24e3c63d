// SPDX-License-Identifier: MIT
// CurveChoice: which curve goes through the points, and how: what the user asked for, checked against the method.
#pragma once

#include "splinefeed/s1_curve/waypoint_curve.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace splinefeed::host {

enum class Method { g2, catmull_rom, polyline, bezier };

/// As the command line and the curve files name it.
[[nodiscard]] std::string_view method_name(Method method) noexcept;

/// The curve options of the command line as they were typed; no value: not given.
struct CurveArguments {
    std::optional<std::string> method;
    std::optional<std::string> parameterization;
    std::optional<std::string> tension;
    std::optional<std::string> corner_angle;
    std::optional<std::string> start_tangent;
    std::optional<std::string> end_tangent;
    bool closed = false;
};

/// A tangent at an end of the curve, in units of the end chord.
struct Tangent {
    int components = 0;
    PerAxis<double> value{};
};

struct CurveChoice {
    Method method = Method::g2;
    bool closed = false;
    Parameterization parameterization = Parameterization::chordal;
    double tension = 0.5;
    double corner_angle_deg = 60.0;
    std::optional<Tangent> start_tangent;
    std::optional<Tangent> end_tangent;
};

/// Reads the options and fills in the method's defaults: g2 chordal, catmull-rom centripetal with tension 1/2, corners
/// from 60 degrees. Throws UsageError where a value is wrong or the method has no such option.
[[nodiscard]] CurveChoice choose_curve(const CurveArguments& arguments);

/// The option that was given first, without its value; empty: none was. For inputs that bring their own curve.
[[nodiscard]] std::string_view first_option(const CurveArguments& arguments) noexcept;

} // namespace splinefeed::host
