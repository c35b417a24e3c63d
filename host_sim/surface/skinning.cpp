// SPDX-License-Identifier: MIT
//
// Skinning: sections with different numbers of points become one surface (Sakude, section 4).
//
// Each section is interpolated by chord parameters on averaged knots over one and the same interval, with one and the
// same degree; the print asks for equal knot vectors only, and both are needed. The knots of all sections are merged
// (the highest multiplicity wins), each section gets those it lacks by Boehm's insertion, which does not change it, and
// the columns of control points are interpolated across. Knots nearer than a tolerance are one: not by moving the knot
// of a finished curve, which would change it, but by interpolating that section on the merged knot in the first place.
#include "host_sim/surface/described_surface.hpp"

#include "host_sim/surface/spine.hpp"
#include "splinefeed/splines/knot_insertion.hpp"
#include "splinefeed/surfaces/surface_interpolation.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr double same_knot = 1e-6; // of the domain

template <Scalar S>
struct Section {
    std::vector<Point<S>> points;
    std::vector<S> parameters;
    std::vector<S> knots;
    std::vector<Point<S>> controls;
};

/// What the description asks for.
struct Skin {
    std::vector<PointList> sections;
    int axes = 0;
    int degree_u = 3;
    int degree_v = 3;
    double domain = 1.0;
};

std::vector<PointList> read_sections(const json& input, std::size_t fewest) {
    const auto array = input.find("sections");
    if (array == input.end() || !array->is_array() || array->size() < 2) {
        throw DescriptionError("\"sections\" must be an array of at least 2 arrays of points");
    }
    std::vector<PointList> sections;
    for (const json& section : *array) {
        const std::string name = fmt::format("\"sections\", section {}", sections.size() + 1);
        sections.push_back(points_of(section, name, fewest));
        if (sections.back().axes != sections.front().axes) {
            throw DescriptionError("{} has points of {} numbers; they must have {}, like the first section", name,
                                   sections.back().axes, sections.front().axes);
        }
    }
    return sections;
}

// Inner knots of all sections in order, each group of near ones as often as in the section that has most of them. The
// sections' own knots become the first of their group.
template <Scalar S>
std::vector<S> merge_knots(std::vector<Section<S>>& sections, std::size_t degree, S domain) {
    std::vector<S> all;
    const auto inner = [degree](Section<S>& section) {
        return std::span(section.knots).subspan(degree + 1, section.knots.size() - 2 * (degree + 1));
    };
    for (Section<S>& section : sections) {
        all.insert(all.end(), inner(section).begin(), inner(section).end());
    }
    std::ranges::sort(all);
    const S tolerance = literal<S>(same_knot) * domain;
    std::vector<S> merged(degree + 1, S{});
    for (std::size_t from = 0; from < all.size();) {
        const S knot = all[from];
        std::size_t to = from;
        while (to < all.size() && all[to] - knot <= tolerance) {
            ++to;
        }
        std::size_t most = 0;
        for (Section<S>& section : sections) {
            std::size_t count = 0;
            for (S& own : inner(section)) {
                if (own >= knot && own <= all[to - 1]) {
                    own = knot;
                    ++count;
                }
            }
            most = std::max(most, count);
        }
        merged.insert(merged.end(), most, knot);
        from = to;
    }
    merged.insert(merged.end(), degree + 1, domain);
    return merged;
}

template <Scalar S>
std::vector<Section<S>> with_parameters(const Skin& skin, const Unit<S>& unit, S domain) {
    std::vector<Section<S>> sections(skin.sections.size());
    for (std::size_t s = 0; s < sections.size(); ++s) {
        Section<S>& section = sections[s];
        section.points = unit.in(skin.sections[s]);
        section.parameters.resize(section.points.size());
        section.knots.resize(open_knot_count(section.points.size(), skin.degree_u));
        const Status status = spline_parameters<S>(section.points, skin.axes, Parameterization::chordal, false, domain,
                                                   section.parameters);
        if (status.error() == Error::coincident_points) {
            throw DescriptionError("\"sections\", section {}: two successive points are the same; leave one out",
                                   s + 1);
        }
        require(status);
        require(open_knots<S>(KnotRule::average, section.parameters, skin.degree_u, false, section.knots));
    }
    return sections;
}

template <Scalar S>
Status interpolate(Section<S>& section, int degree, int axes) {
    const InterpolationKind kind{degree};
    std::vector<S> entries(kind.band(section.points.size()).entries());
    BsplineInterpolation<S> system;
    require(system.prepare(kind, section.parameters, section.knots, entries, {}));
    section.controls.resize(section.points.size());
    return system.interpolate(section.points, nullptr, axes, section.controls);
}

template <Scalar S>
std::vector<Point<S>> refined(const Section<S>& section, int degree, int axes, const std::vector<S>& merged) {
    std::vector<S> knots = section.knots;
    std::vector<Point<S>> controls = section.controls;
    knots.resize(merged.size());
    controls.resize(merged.size() - static_cast<std::size_t>(degree) - 1);
    GrowingCurve<S> curve{degree, axes, section.knots.size(), knots, controls};
    require(refine_knots<S>(curve, merged));
    return controls;
}

// The columns of the net, [j * sections + s], are interpolated across: all share the means of their chord parameters.
template <Scalar S>
Status interpolate_across(const Skin& skin, std::vector<Point<S>>& net, DescribedSurface& surface) {
    const std::size_t count = skin.sections.size();
    const std::size_t along = net.size() / count;
    const double unit = parameter_unit<S>(1.0);
    std::vector<S> params(count);
    std::vector<S> knots(open_knot_count(count, skin.degree_v));
    std::vector<Point<S>> row(std::max(along, count));
    std::vector<S> row_parameters(row.size());
    SurfaceStorage<S> storage;
    storage.row = row;
    storage.row_parameters = row_parameters;
    const Status status = grid_parameters<S>({skin.axes, along, count, net}, SurfaceDirection::v,
                                             Parameterization::chordal, from_double<S>(1.0 / unit), storage, params);
    if (status.error() == Error::coincident_points) {
        throw DescriptionError("two successive sections of \"sections\" are the same; leave one out");
    }
    require(status);
    require(open_knots<S>(KnotRule::average, params, skin.degree_v, false, knots));
    const InterpolationKind kind{skin.degree_v};
    std::vector<S> entries(kind.band(count).entries());
    BsplineInterpolation<S> system;
    require(system.prepare(kind, params, knots, entries, {}));
    surface.params_v = out_of_units(params, unit);
    surface.knots_v = out_of_units(knots, unit);
    for (std::size_t j = 0; j < along; ++j) {
        if (const Status solved = system.solve(net, skin.axes, j * count, 1); !solved.ok()) {
            return solved;
        }
    }
    return {};
}

template <Scalar S>
DescribedSurface through(const Skin& skin, const Unit<S>& unit, Error& error) {
    const double unit_u = parameter_unit<S>(skin.domain);
    const S domain = from_double<S>(skin.domain / unit_u);
    std::vector<Section<S>> sections = with_parameters(skin, unit, domain);
    const std::vector<S> merged = merge_knots(sections, static_cast<std::size_t>(skin.degree_u), domain);
    DescribedSurface surface;
    surface.axes = skin.axes;
    surface.degree_u = skin.degree_u;
    surface.degree_v = skin.degree_v;
    surface.knots_u = out_of_units(merged, unit_u);
    const std::size_t count = sections.size();
    std::vector<Point<S>> net((merged.size() - static_cast<std::size_t>(skin.degree_u) - 1) * count);
    ordered_json section_knots = ordered_json::array();
    ordered_json section_controls = ordered_json::array();
    ordered_json refined_controls = ordered_json::array();
    for (std::size_t s = 0; s < count; ++s) {
        error = interpolate(sections[s], skin.degree_u, skin.axes).error();
        if (error != Error::none) {
            return surface;
        }
        const std::vector<Point<S>> controls = refined(sections[s], skin.degree_u, skin.axes, merged);
        for (std::size_t j = 0; j < controls.size(); ++j) {
            net[j * count + s] = controls[j];
        }
        section_knots.push_back(out_of_units(sections[s].knots, unit_u));
        section_controls.push_back(to_json(sections[s].controls, skin.axes, unit));
        refined_controls.push_back(to_json(controls, skin.axes, unit));
    }
    error = interpolate_across(skin, net, surface).error();
    surface.net = unit.out(net);
    surface.results["section_knots"] = section_knots;
    surface.results["section_control_points"] = section_controls;
    surface.results["merged_knots_u"] = surface.knots_u;
    surface.results["refined_control_points"] = refined_controls;
    return surface;
}

template <Scalar S>
DescribedSurface skin_surface(const Skin& skin) {
    double largest = 0.0;
    for (const PointList& list : skin.sections) {
        largest = std::max(largest, list.largest());
    }
    return in_fitting_unit<S>(largest, [&](const Unit<S>& unit, Error& error) { return through(skin, unit, error); });
}

} // namespace

DescribedSurface describe_skin(const json& input, ScalarKind scalar) {
    require_known(input, {"sections", "degree_u", "degree_v", "domain_length", "spine"});
    Skin skin;
    skin.sections = read_sections(input, 2);
    std::size_t fewest = skin.sections.front().points.size();
    for (const PointList& list : skin.sections) {
        fewest = std::min(fewest, list.points.size());
    }
    skin.degree_u = degree_in(input, "degree_u", fewest, "points of the shortest section");
    skin.degree_v = degree_in(input, "degree_v", skin.sections.size(), "sections");
    skin.domain = number_in(input, "domain_length", 1.0);
    if (!(skin.domain > 0.0)) {
        throw DescriptionError("\"domain_length\" must be greater than 0");
    }
    carry_along_spine(input, skin.sections);
    skin.axes = skin.sections.front().axes;
    switch (scalar) {
    case ScalarKind::fixed: return skin_surface<Fixed>(skin);
    case ScalarKind::float32: return skin_surface<float>(skin);
    case ScalarKind::float64: return skin_surface<double>(skin);
    }
    return {};
}

} // namespace splinefeed::host
