// SPDX-License-Identifier: MIT
#include "host_sim/curve/curve_arguments.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/nearest_name.hpp"
#include "host_sim/base/option_number.hpp"
#include "host_sim/config/path_tolerances.hpp"
#include "host_sim/curve/methods/method_table.hpp"
#include "host_sim/curve/streamed_curve.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

const CurveMethod* find_method(std::string_view name) noexcept {
    for (const StreamingMethod& row : streaming_methods()) {
        if (row.method.name == name) {
            return &row.method;
        }
    }
    const PointsMethod* const of_points = points_method(name);
    return of_points == nullptr ? nullptr : &of_points->method;
}

const CurveMethod& known_method(std::string_view name) {
    if (const CurveMethod* const method = find_method(name)) {
        return *method;
    }
    const std::string available = listed(curve_names());
    if (name == "bezier") {
        throw UsageError(
            "--curve bezier: a Bezier curve is read from a curve file (.json), without --curve; from waypoints "
            "there are " +
            available);
    }
    throw UsageError(fmt::format("--curve {}: there is no such method; available are {}", in_quotes(name), available));
}

Parameterization read_parameterization(std::string_view text) {
    constexpr std::array<std::string_view, 3> names{"uniform", "chordal", "centripetal"};
    const auto* const found = std::find(names.begin(), names.end(), text);
    if (found == names.end()) {
        throw UsageError(fmt::format("--parameterization {}: it must be one of {}", in_quotes(text), listed(names)));
    }
    return static_cast<Parameterization>(found - names.begin());
}

// A direction in units of the end chord; or, for methods of all points, the derivative itself, which may be zero: a
// cusp.
Tangent read_tangent(std::string_view option, std::string_view text, bool derivative) {
    Tangent tangent;
    bool zero = true;
    for (std::string_view rest = text;;) {
        const std::size_t comma = rest.find(',');
        if (tangent.components == max_axes) {
            throw UsageError(fmt::format("{} {} has more than {} components", option, in_quotes(text), max_axes));
        }
        const double most = derivative ? 1e6 : 100.0;
        const double value =
            read_option_number(option, rest.substr(0, comma), -most, most, "each component of an end tangent");
        tangent.value[static_cast<unsigned>(tangent.components++)] = value;
        zero = zero && value == 0.0;
        if (comma == std::string_view::npos) {
            break;
        }
        rest.remove_prefix(comma + 1);
    }
    if (zero && !derivative) {
        throw UsageError(fmt::format("{} {} has no direction; give a vector like 1,0,0", option, in_quotes(text)));
    }
    return tangent;
}

} // namespace

std::vector<std::string_view> curve_names() {
    std::vector<std::string_view> names;
    for (const StreamingMethod& row : streaming_methods()) {
        names.push_back(row.method.name);
    }
    for (const PointsMethod& row : points_methods()) {
        names.push_back(row.method.name);
    }
    return names;
}

bool passes_waypoints(std::string_view curve_name) noexcept {
    const CurveMethod* const method = find_method(curve_name);
    return method == nullptr || method->passes_waypoints;
}

CurveChoice choose_curve(const CurveArguments& arguments) {
    const CurveMethod& row = known_method(arguments.method.value_or("g2"));
    CurveChoice choice;
    choice.method = row.name;
    choice.closed = arguments.closed;
    choice.smooth = arguments.smooth;
    choice.parameterization = row.usual;
    choice.corner_angle_deg = row.usual_corner_angle_deg;
    choice.tension = row.usual_tension;
    const auto require = [&row](unsigned what, std::string_view option) {
        if ((row.takes & what) == 0) {
            throw UsageError(fmt::format("--curve {} has no option {}; leave it out", row.name, option));
        }
    };
    if (arguments.tolerance) {
        if ((row.takes & takes_tolerance) == 0) {
            throw UsageError(fmt::format("--curve {} has no option --tolerance; it goes with --curve polyline, or with "
                                         "a file of elements (.json)",
                                         row.name));
        }
        choice.tolerance_mm = read_tolerance(*arguments.tolerance);
        if (choice.closed && choice.tolerance_mm > 0.0) {
            throw UsageError(
                "--tolerance and --closed exclude each other; repeat the first waypoint at the end instead");
        }
    }
    // Reads an option that was given.
    const auto take = [&require](const std::optional<std::string>& text, unsigned what, std::string_view option,
                                 double low, double high, std::string_view name, auto& out) {
        if (text) {
            require(what, option);
            out = read_option_number(option, *text, low, high, name);
        }
    };
    if (arguments.smooth) {
        require(takes_smooth, "--smooth");
    }
    if (arguments.parameterization) {
        require(takes_parameterization, "--parameterization");
        choice.parameterization = read_parameterization(*arguments.parameterization);
    }
    if (arguments.knots) {
        require(takes_knots, "--knots");
        if (*arguments.knots != "uniform" && *arguments.knots != "averaged") {
            throw UsageError(
                fmt::format("--knots {}: it must be one of uniform, averaged", in_quotes(*arguments.knots)));
        }
        choice.knots = arguments.knots;
    }
    if (arguments.factor) {
        require(takes_factor, "--factor");
        if (*arguments.factor != "chord" && *arguments.factor != "constant") {
            throw UsageError(
                fmt::format("--factor {}: it must be one of chord, constant", in_quotes(*arguments.factor)));
        }
        choice.constant_factor = *arguments.factor == "constant";
    }
    if (arguments.degree) {
        require(takes_degree, "--degree");
        choice.degree = read_option_integer("--degree", *arguments.degree, row.lowest_degree, row.highest_degree);
    }
    if (arguments.curvature_sign) {
        require(takes_joints, "--curvature-sign");
        choice.curvature_sign.reset();
    }
    if (arguments.curvature_sign && *arguments.curvature_sign != "auto") {
        choice.curvature_sign = read_option_integer("--curvature-sign", *arguments.curvature_sign, -1, 1);
        if (choice.curvature_sign == 0) {
            throw UsageError("--curvature-sign 0: it must be 1, -1 or auto");
        }
    }
    take(arguments.tension, takes_tension, "--tension", 0.0, row.highest_tension, "the tension", choice.tension);
    take(arguments.beta1, takes_betas, "--beta1", 1e-3, 1e3, "the bias", choice.beta1);
    take(arguments.beta2, takes_betas, "--beta2", row.lowest_beta2, 1e3, "the tension", choice.beta2);
    // What FergusonJoint takes in every scalar.
    take(arguments.lambda, takes_joints, "--lambda", 0.0625, 16.0, "lambda", choice.lambda);
    if (!arguments.mu || *arguments.mu != "auto") {
        take(arguments.mu, takes_joints, "--mu", -65536.0, 65536.0, "mu", choice.mu);
    }
    take(arguments.corner_angle, takes_corners, "--corner-angle", 0.0, 180.0, "the corner angle in degrees",
         choice.corner_angle_deg);
    for (const auto& [text, option, tangent] :
         {std::tuple{&arguments.start_tangent, "--start-tangent", &choice.start_tangent},
          std::tuple{&arguments.end_tangent, "--end-tangent", &choice.end_tangent}}) {
        if (!*text) {
            continue;
        }
        require(takes_tangents, option);
        if (choice.closed) {
            throw UsageError(fmt::format("{} and --closed exclude each other: a closed curve has no ends", option));
        }
        *tangent = read_tangent(option, **text, points_method(choice.method) != nullptr);
    }
    return choice;
}

double read_tolerance(const std::string& text) {
    return read_option_number("--tolerance", text, 0.0, largest_tolerance_mm, "the tolerance in mm");
}

std::string_view first_option(const CurveArguments& arguments) noexcept {
    const std::array<std::pair<bool, std::string_view>, 15> given{{
        {arguments.method.has_value(), "--curve"},
        {arguments.closed, "--closed"},
        {arguments.degree.has_value(), "--degree"},
        {arguments.parameterization.has_value(), "--parameterization"},
        {arguments.knots.has_value(), "--knots"},
        {arguments.tension.has_value(), "--tension"},
        {arguments.factor.has_value(), "--factor"},
        {arguments.beta1.has_value(), "--beta1"},
        {arguments.beta2.has_value(), "--beta2"},
        {arguments.lambda.has_value(), "--lambda"},
        {arguments.mu.has_value(), "--mu"},
        {arguments.curvature_sign.has_value(), "--curvature-sign"},
        {arguments.corner_angle.has_value(), "--corner-angle"},
        {arguments.start_tangent.has_value(), "--start-tangent"},
        {arguments.end_tangent.has_value(), "--end-tangent"},
    }};
    const auto* const first = std::find_if(given.begin(), given.end(), [](const auto& option) { return option.first; });
    return first == given.end() ? "" : first->second;
}

} // namespace splinefeed::host
