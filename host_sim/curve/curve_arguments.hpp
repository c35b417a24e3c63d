// SPDX-License-Identifier: MIT
// CurveArguments: the curve options of the command line, and the choice that they make.
#pragma once

#include "host_sim/curve/methods/curve_choice.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace splinefeed::host {

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
    std::optional<std::string> tolerance;
    std::optional<std::string> start_tangent;
    std::optional<std::string> end_tangent;
    bool closed = false;
    bool smooth = false;
};

/// The names of all methods that --curve may name.
[[nodiscard]] std::vector<std::string_view> curve_names();
[[nodiscard]] bool passes_waypoints(std::string_view curve_name) noexcept;

/// Reads the options and fills in the method's defaults: g2 chordal, catmull-rom centripetal with tension 1/2, corners
/// from 60 degrees (bspline: none). Throws UsageError where a value is wrong or the method has no such option.
[[nodiscard]] CurveChoice choose_curve(const CurveArguments& arguments);

/// The tolerance of --tolerance in mm. Throws UsageError.
[[nodiscard]] double read_tolerance(const std::string& text);

/// The option that was given first, without its value; empty: none was. For inputs that bring their own curve;
/// --smooth and
/// --tolerance go with these, too, and are not counted.
[[nodiscard]] std::string_view first_option(const CurveArguments& arguments) noexcept;

} // namespace splinefeed::host
