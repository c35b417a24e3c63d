// SPDX-License-Identifier: MIT
#include "host_sim/curve/points_description.hpp"

#include "host_sim/curve/methods/description.hpp"

#include <fmt/format.h>

namespace splinefeed::host {

namespace {

using nlohmann::json;

json point_json(const PerAxis<double>& point, int axes) {
    json array = json::array();
    for (unsigned k = 0; k < static_cast<unsigned>(axes); ++k) {
        array.push_back(point[k]);
    }
    return array;
}

json tangent_json(const std::optional<Tangent>& tangent, int axes) {
    return tangent ? point_json(tangent->value, axes) : json(nullptr);
}

json range_json(const std::vector<PerAxis<double>>& points, std::size_t first, std::size_t count, int axes) {
    json array = json::array();
    for (std::size_t i = first; i < first + count; ++i) {
        array.push_back(point_json(points[i], axes));
    }
    return array;
}

void interpolation_input(json& input, const CurveChoice& choice, int axes) {
    constexpr std::array<const char*, 3> parameters{"uniform", "chord", "centripetal"};
    input["degree"] = choice.degree;
    input["parameters"] = parameters[static_cast<std::size_t>(choice.parameterization)];
    const bool tangents = choice.start_tangent && choice.end_tangent;
    if (choice.start_tangent.has_value() != choice.end_tangent.has_value()) {
        throw DescriptionError("bspline-interpolation takes both end tangents, or none; give --start-tangent and "
                               "--end-tangent");
    }
    if (choice.knots) {
        input["knots"] = *choice.knots == "uniform" ? "uniform" : tangents ? "average_tangents" : "average";
    } else if (tangents) {
        input["knots"] = "average_tangents";
    } else if (choice.closed) {
        input["knots"] = choice.degree % 2 == 1 ? "params" : "midpoints";
    } else {
        input["knots"] = "average";
    }
    input["derivative_start"] = tangent_json(choice.start_tangent, axes);
    input["derivative_end"] = tangent_json(choice.end_tangent, axes);
}

// The first polygon takes degree + 1 points, each further one the degree - 2 that G2 leaves free.
void chain_input(json& input, const CurveChoice& choice, const std::vector<PerAxis<double>>& points, int axes) {
    constexpr std::size_t order = 2;
    const auto degree = static_cast<std::size_t>(choice.degree);
    const std::size_t free = degree - order;
    const std::size_t first = choice.closed ? 0 : degree + 1;
    if (points.size() < first || (free > 0 && (points.size() - first) % free != 0) ||
        (free == 0 && points.size() != first)) {
        throw DescriptionError(fmt::format(
            "there are {} points; a chain of degree {} takes {} for its first polygon and {} for each one after it",
            points.size(), degree, first, free));
    }
    input["degree"] = choice.degree;
    input["order"] = order;
    input["first_polygon"] = choice.closed ? json(nullptr) : range_json(points, 0, first, axes);
    json polygons = json::array();
    for (std::size_t i = first; i < points.size(); i += free) {
        polygons.push_back(range_json(points, i, free, axes));
    }
    json betas = json::array();
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        betas.push_back({{"beta1", choice.beta1.value_or(1.0)}, {"beta2", choice.beta2}});
    }
    input["free_points"] = polygons;
    input["betas"] = betas;
}

void ferguson_input(json& input, const CurveChoice& choice, int axes) {
    input["lambda"] = choice.lambda;
    input["mu"] = choice.mu ? json(*choice.mu) : json("auto");
    input["delta"] = choice.curvature_sign ? json(*choice.curvature_sign) : json("auto");
    input["t_start"] = tangent_json(choice.start_tangent, axes);
    input["t_end"] = tangent_json(choice.end_tangent, axes);
}

} // namespace

std::string_view description_name(Method method) noexcept {
    switch (method) {
    case Method::bspline_interpolation: return "bspline_interpolation";
    case Method::ferguson: return "ferguson";
    case Method::beta_chain: return "beta_chain";
    default: return "";
    }
}

json points_description(const CurveChoice& choice, const std::vector<PerAxis<double>>& points, int axes) {
    json input;
    input["closed"] = choice.closed;
    if (choice.method == Method::beta_chain) {
        chain_input(input, choice, points, axes);
        return input;
    }
    input["points"] = range_json(points, 0, points.size(), axes);
    if (choice.method == Method::ferguson) {
        ferguson_input(input, choice, axes);
    } else {
        interpolation_input(input, choice, axes);
    }
    return input;
}

} // namespace splinefeed::host
