// SPDX-License-Identifier: MIT
#include "host_sim/curve/curve_arguments.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/nearest_name.hpp"
#include "host_sim/base/option_number.hpp"
#include "host_sim/base/trimmed_text.hpp"
#include "host_sim/config/path_tolerances.hpp"
#include "host_sim/curve/methods/method_table.hpp"
#include "host_sim/curve/streamed_curve.hpp"

#include <algorithm>
#include <array>

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
    throw UsageError("--curve {}: there is no such method; available are {}", in_quotes(name), available);
}

template <std::size_t count>
std::size_t read_word(std::string_view option, std::string_view text,
                      const std::array<std::string_view, count>& words) {
    const auto* const found = std::ranges::find(words, text);
    if (found == words.end()) {
        throw UsageError("{} {}: it must be one of {}", option, in_quotes(text), listed(words));
    }
    return static_cast<std::size_t>(found - words.begin());
}

// A direction in units of the end chord; or, for methods of all points, the derivative itself, which may be zero: a
// cusp.
Tangent read_tangent(std::string_view option, std::string_view text, bool derivative) {
    Tangent tangent;
    bool zero = true;
    for (const std::string_view part : split(text, ',')) {
        if (tangent.components == max_axes) {
            throw UsageError("{} {} has more than {} components", option, in_quotes(text), max_axes);
        }
        const double most = derivative ? 1e6 : 100.0;
        const double value = read_option_number(option, part, -most, most, "each component of an end tangent");
        tangent.value[static_cast<unsigned>(tangent.components++)] = value;
        zero = zero && value == 0.0;
    }
    if (zero && !derivative) {
        throw UsageError("{} {} has no direction; give a vector like 1,0,0", option, in_quotes(text));
    }
    return tangent;
}

void must_take(const CurveMethod& method, unsigned what, std::string_view option) {
    if ((method.takes & what) == 0) {
        throw UsageError("--curve {} has no option {}; leave it out", method.name, option);
    }
}

void choose_tolerance(const CurveArguments& arguments, const CurveMethod& method, CurveChoice& choice) {
    if (!arguments.tolerance) {
        return;
    }
    if ((method.takes & takes_tolerance) == 0) {
        throw UsageError("--curve {} has no option --tolerance; it goes with --curve polyline, or with "
                         "a file of elements (.json)",
                         method.name);
    }
    choice.tolerance_mm = read_tolerance(*arguments.tolerance);
    if (choice.closed && choice.tolerance_mm > 0.0) {
        throw UsageError("--tolerance and --closed exclude each other; repeat the first waypoint at the end instead");
    }
}

void choose_words(const CurveArguments& arguments, const CurveMethod& method, CurveChoice& choice) {
    if (arguments.smooth) {
        must_take(method, takes_smooth, "--smooth");
    }
    if (arguments.parameterization) {
        must_take(method, takes_parameterization, "--parameterization");
        choice.parameterization = static_cast<Parameterization>(
            read_word<3>("--parameterization", *arguments.parameterization, {"uniform", "chordal", "centripetal"}));
    }
    if (arguments.knots) {
        must_take(method, takes_knots, "--knots");
        static_cast<void>(read_word<2>("--knots", *arguments.knots, {"uniform", "averaged"}));
        choice.knots = arguments.knots;
    }
    if (arguments.factor) {
        must_take(method, takes_factor, "--factor");
        choice.constant_factor = read_word<2>("--factor", *arguments.factor, {"chord", "constant"}) == 1;
    }
}

void choose_numbers(const CurveArguments& arguments, const CurveMethod& method, CurveChoice& choice) {
    if (arguments.degree) {
        must_take(method, takes_degree, "--degree");
        choice.degree = read_option_integer("--degree", *arguments.degree, method.lowest_degree, method.highest_degree);
    }
    if (arguments.curvature_sign) {
        must_take(method, takes_joints, "--curvature-sign");
        choice.curvature_sign.reset();
        if (*arguments.curvature_sign != "auto") {
            choice.curvature_sign = read_option_integer("--curvature-sign", *arguments.curvature_sign, -1, 1);
        }
        if (choice.curvature_sign == 0) {
            throw UsageError("--curvature-sign 0: it must be 1, -1 or auto");
        }
    }
    const auto take = [&method](const std::optional<std::string>& text, unsigned what, std::string_view option,
                                double low, double high, std::string_view name, auto& out) {
        if (text) {
            must_take(method, what, option);
            out = read_option_number(option, *text, low, high, name);
        }
    };
    take(arguments.tension, takes_tension, "--tension", 0.0, method.highest_tension, "the tension", choice.tension);
    take(arguments.beta1, takes_betas, "--beta1", 1e-3, 1e3, "the bias", choice.beta1);
    take(arguments.beta2, takes_betas, "--beta2", method.lowest_beta2, 1e3, "the tension", choice.beta2);
    // What FergusonJoint takes in every scalar.
    take(arguments.lambda, takes_joints, "--lambda", 0.0625, 16.0, "lambda", choice.lambda);
    if (!arguments.mu || *arguments.mu != "auto") {
        take(arguments.mu, takes_joints, "--mu", -65536.0, 65536.0, "mu", choice.mu);
    }
    take(arguments.corner_angle, takes_corners, "--corner-angle", 0.0, 180.0, "the corner angle in degrees",
         choice.corner_angle_deg);
}

void choose_tangent(const std::optional<std::string>& text, std::string_view option, const CurveMethod& method,
                    const CurveChoice& choice, std::optional<Tangent>& out) {
    if (!text) {
        return;
    }
    must_take(method, takes_tangents, option);
    if (choice.closed) {
        throw UsageError("{} and --closed exclude each other: a closed curve has no ends", option);
    }
    out = read_tangent(option, *text, points_method(choice.method) != nullptr);
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
    choose_tolerance(arguments, row, choice);
    choose_words(arguments, row, choice);
    choose_numbers(arguments, row, choice);
    choose_tangent(arguments.start_tangent, "--start-tangent", row, choice, choice.start_tangent);
    choose_tangent(arguments.end_tangent, "--end-tangent", row, choice, choice.end_tangent);
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
    const auto* const first = std::ranges::find_if(given, [](const auto& option) { return option.first; });
    return first == given.end() ? "" : first->second;
}

} // namespace splinefeed::host
