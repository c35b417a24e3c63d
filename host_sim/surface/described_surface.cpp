// SPDX-License-Identifier: MIT
#include "host_sim/surface/described_surface.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/nearest_name.hpp"
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
            throw DescriptionError("{} has {} points of {} numbers; it must have {} of {}, like the first", name,
                                   points.points.size(), points.axes, columns, all.axes);
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

struct Grid {
    PointList list;
    std::size_t rows = 0;
    std::size_t columns = 0;
    SurfaceKind kind;
};

template <Scalar S>
DescribedSurface through(const Grid& grid, const Unit<S>& unit, Error& error) {
    const std::size_t longest = std::max(grid.rows, grid.columns);
    const double length_u = static_cast<double>(grid.rows) - grid.kind.degree_u;
    const double length_v = static_cast<double>(grid.columns) - grid.kind.degree_v;
    const double unit_u = parameter_unit<S>(length_u);
    const double unit_v = parameter_unit<S>(length_v);
    const std::vector<Point<S>> points = unit.in(grid.list);
    std::vector<S> entries(grid.kind.entries(grid.rows, grid.columns));
    std::vector<S> row_parameters(longest);
    std::vector<Point<S>> row(longest);
    std::vector<S> params_u(grid.rows);
    std::vector<S> params_v(grid.columns);
    std::vector<S> knots_u(open_knot_count(grid.rows, grid.kind.degree_u));
    std::vector<S> knots_v(open_knot_count(grid.columns, grid.kind.degree_v));
    std::vector<Point<S>> net(points.size());
    error = interpolate_surface<S>({grid.list.axes, grid.rows, grid.columns, points}, grid.kind,
                                   from_double<S>(length_u / unit_u), from_double<S>(length_v / unit_v),
                                   {params_u, params_v, knots_u, knots_v, net, entries, row, row_parameters})
                .error();
    return {grid.list.axes,
            grid.kind.degree_u,
            grid.kind.degree_v,
            out_of_units(params_u, unit_u),
            out_of_units(params_v, unit_v),
            out_of_units(knots_u, unit_u),
            out_of_units(knots_v, unit_v),
            unit.out(net),
            {}};
}

template <Scalar S>
DescribedSurface grid_surface(const Grid& grid) {
    return in_fitting_unit<S>(grid.list.largest(), [&](const Unit<S>& unit, Error& error) {
        DescribedSurface surface = through(grid, unit, error);
        if (error == Error::coincident_points) {
            throw DescriptionError("in every row (or column) of \"grid\" two neighbours coincide; leave them out, or "
                                   "give \"parameters\": \"uniform\"");
        }
        return surface;
    });
}

} // namespace

int degree_in(const json& input, const char* key, std::size_t points, std::string_view what) {
    const int highest = static_cast<int>(std::min<std::size_t>(points - 1, max_degree));
    const int degree = integer_in(input, key, 1, max_degree, std::min(3, highest));
    if (degree > highest) {
        throw DescriptionError("\"{}\" is {}; {} {} allow {} at most", key, degree, points, what, highest);
    }
    return degree;
}

DescribedSurface describe_grid(const json& input, ScalarKind scalar) {
    require_known(input, {"grid", "degree_u", "degree_v", "parameters", "knots"});
    Grid grid;
    grid.list = read_grid(input, grid.rows);
    grid.columns = grid.list.points.size() / grid.rows;
    grid.kind.degree_u = degree_in(input, "degree_u", grid.rows, "rows");
    grid.kind.degree_v = degree_in(input, "degree_v", grid.columns, "columns");
    constexpr std::array how{Parameterization::uniform, Parameterization::chordal, Parameterization::chordal,
                             Parameterization::centripetal};
    grid.kind.parameters = how[choice_in(input, "parameters", {"uniform", "chord", "chordal", "centripetal"}, 1)];
    grid.kind.knots = choice_in(input, "knots", {"average", "uniform"}, 0) == 0 ? KnotRule::average : KnotRule::uniform;
    switch (scalar) {
    case ScalarKind::fixed: return grid_surface<Fixed>(grid);
    case ScalarKind::float32: return grid_surface<float>(grid);
    case ScalarKind::float64: return grid_surface<double>(grid);
    }
    return {};
}

DescribedSurface describe_surface(std::string_view method, const json& input, ScalarKind scalar) {
    if (method == "bspline_surface") {
        return describe_grid(input, scalar);
    }
    if (method == "bspline_skin") {
        return describe_skin(input, scalar);
    }
    constexpr std::array<std::string_view, 2> methods{"bspline_surface", "bspline_skin"};
    throw DescriptionError("\"method\" {} is no surface; it must be one of {}", in_quotes(method), listed(methods));
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
