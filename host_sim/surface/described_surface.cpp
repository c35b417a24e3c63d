// SPDX-License-Identifier: MIT
#include "host_sim/surface/described_surface.hpp"

#include "host_sim/input_error.hpp"
#include "host_sim/nearest_name.hpp"
#include "splinefeed/surfaces/surface_interpolation.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

PointList read_grid(const json& input, std::size_t& rows) {
    const auto grid = input.find("grid");
    if (grid == input.end() || !grid->is_array() || grid->size() < 2) {
        throw DescriptionError("\"grid\" must be an array of at least 2 rows of points");
    }
    PointList all;
    rows = grid->size();
    std::size_t columns = 0;
    for (const json& row : *grid) {
        const std::string name = fmt::format("\"grid\", row {}", columns == 0 ? 1 : all.points.size() / columns + 1);
        const PointList points = points_of(row, name, 2);
        columns = columns == 0 ? points.points.size() : columns;
        all.axes = all.axes == 0 ? points.axes : all.axes;
        if (points.points.size() != columns || points.axes != all.axes) {
            throw DescriptionError(fmt::format("{} has {} points of {} numbers; it must have {} of {}, like the first",
                                               name, points.points.size(), points.axes, columns, all.axes));
        }
        all.points.insert(all.points.end(), points.points.begin(), points.points.end());
    }
    return all;
}

ordered_json net_json(const DescribedSurface& surface) {
    ordered_json net = ordered_json::array();
    const std::size_t columns = surface.view().count_v();
    for (std::size_t i = 0; i < surface.net.size(); ++i) {
        if (i % columns == 0) {
            net.push_back(ordered_json::array());
        }
        net.back().push_back(to_json(surface.net[i], surface.axes));
    }
    return net;
}

// The nine places of the reference vectors, as fractions of the domain: corners, edges, inside.
ordered_json samples_json(const DescribedSurface& surface) {
    constexpr std::array<std::pair<double, double>, 9> places{{{0.0, 0.0},
                                                               {0.125, 0.375},
                                                               {0.25, 0.875},
                                                               {0.5, 0.5},
                                                               {0.625, 0.125},
                                                               {0.875, 0.75},
                                                               {1.0, 1.0},
                                                               {0.375, 0.0},
                                                               {0.0, 0.625}}};
    const BSplineSurface<double> view = surface.view();
    ordered_json samples = ordered_json::array();
    for (const auto& [fraction_u, fraction_v] : places) {
        const double u = view.first_u() + fraction_u * (view.last_u() - view.first_u());
        const double v = view.first_v() + fraction_v * (view.last_v() - view.first_v());
        const SurfaceJet<double> jet = evaluate(view, u, v);
        const auto scaled = [&surface](const Point<double>& vector, double divisor) {
            Point<double> out{};
            for (std::size_t k = 0; k < out.size(); ++k) {
                out[k] = vector[k] / divisor;
            }
            return to_json(out, surface.axes);
        };
        ordered_json row;
        row["u"] = u;
        row["v"] = v;
        row["S"] = to_json(jet.position, surface.axes);
        row["Su"] = scaled(jet.u, jet.length_u);
        row["Sv"] = scaled(jet.v, jet.length_v);
        row["Suu"] = scaled(jet.uu, jet.length_u * jet.length_u);
        row["Suv"] = scaled(jet.uv, jet.length_u * jet.length_v);
        row["Svv"] = scaled(jet.vv, jet.length_v * jet.length_v);
        samples.push_back(row);
    }
    return samples;
}

} // namespace

int degree_in(const json& input, const char* key, std::size_t points, std::string_view what) {
    const int highest = static_cast<int>(std::min<std::size_t>(points - 1, max_degree));
    const int degree = integer_in(input, key, 1, max_degree, std::min(3, highest));
    if (degree > highest) {
        throw DescriptionError(fmt::format("\"{}\" is {}; {} {} allow {} at most", key, degree, points, what, highest));
    }
    return degree;
}

DescribedSurface describe_grid(const json& input) {
    std::size_t rows = 0;
    const PointList list = read_grid(input, rows);
    const std::size_t columns = list.points.size() / rows;
    DescribedSurface surface;
    surface.axes = list.axes;
    surface.degree_u = degree_in(input, "degree_u", rows, "rows");
    surface.degree_v = degree_in(input, "degree_v", columns, "columns");
    constexpr std::array how{Parameterization::uniform, Parameterization::chordal, Parameterization::chordal,
                             Parameterization::centripetal};
    SurfaceKind kind{surface.degree_u, surface.degree_v};
    kind.parameters = how[choice_in(input, "parameters", {"uniform", "chord", "chordal", "centripetal"}, 1)];
    kind.knots = choice_in(input, "knots", {"average", "uniform"}, 0) == 0 ? KnotRule::average : KnotRule::uniform;
    const std::vector<Point<double>> grid = Unit<double>(list.largest(), 1.0).in(list);
    const std::size_t longest = std::max(rows, columns);
    std::vector<double> entries(kind.entries(rows, columns));
    std::vector<double> row_parameters(longest);
    std::vector<Point<double>> row(longest);
    surface.params_u.resize(rows);
    surface.params_v.resize(columns);
    surface.knots_u.resize(open_knot_count(rows, kind.degree_u));
    surface.knots_v.resize(open_knot_count(columns, kind.degree_v));
    surface.net.resize(rows * columns);
    const auto result =
        interpolate_surface<double>({list.axes, rows, columns, grid}, kind, static_cast<double>(rows) - kind.degree_u,
                                    static_cast<double>(columns) - kind.degree_v,
                                    {surface.params_u, surface.params_v, surface.knots_u, surface.knots_v, surface.net,
                                     entries, row, row_parameters});
    if (result.error() == Error::coincident_points) {
        throw DescriptionError("in every row (or column) of \"grid\" two neighbours coincide; leave them out, or give "
                               "\"parameters\": \"uniform\"");
    }
    require(result.error());
    return surface;
}

DescribedSurface describe_surface(std::string_view method, const json& input) {
    if (method == "bspline_surface") {
        return describe_grid(input);
    }
    if (method == "bspline_skin") {
        return describe_skin(input);
    }
    constexpr std::array<std::string_view, 2> methods{"bspline_surface", "bspline_skin"};
    throw DescriptionError(
        fmt::format("\"method\" {} is no surface; it must be one of {}", in_quotes(method), listed(methods)));
}

ordered_json surface_report(const DescribedSurface& surface) {
    ordered_json report;
    report["degree_u"] = surface.degree_u;
    report["degree_v"] = surface.degree_v;
    report["params_u"] = surface.params_u.empty() ? ordered_json(nullptr) : ordered_json(surface.params_u);
    report["params_v"] = surface.params_v;
    report["knots_u"] = surface.knots_u;
    report["knots_v"] = surface.knots_v;
    report["net"] = net_json(surface);
    report["samples"] = samples_json(surface);
    for (const auto& [key, value] : surface.results.items()) {
        report[key] = value;
    }
    return report;
}

} // namespace splinefeed::host
