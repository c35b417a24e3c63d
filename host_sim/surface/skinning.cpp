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

struct Section {
    std::vector<Point<double>> points;
    std::vector<double> parameters;
    std::vector<double> knots;
    std::vector<Point<double>> controls;
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
            throw DescriptionError(fmt::format("{} has points of {} numbers; they must have {}, like the first section",
                                               name, sections.back().axes, sections.front().axes));
        }
    }
    return sections;
}

// Inner knots of all sections in order, each group of near ones as often as in the section that has most of them. The
// sections' own knots become the first of their group.
std::vector<double> merge_knots(std::vector<Section>& sections, std::size_t degree, double domain) {
    std::vector<double> all;
    const auto inner = [degree](Section& section) {
        return std::span(section.knots).subspan(degree + 1, section.knots.size() - 2 * (degree + 1));
    };
    for (Section& section : sections) {
        all.insert(all.end(), inner(section).begin(), inner(section).end());
    }
    std::sort(all.begin(), all.end());
    std::vector<double> merged(degree + 1, 0.0);
    for (std::size_t from = 0; from < all.size();) {
        const double knot = all[from];
        std::size_t to = from;
        while (to < all.size() && all[to] - knot <= same_knot * domain) {
            ++to;
        }
        std::size_t most = 0;
        for (Section& section : sections) {
            std::size_t count = 0;
            for (double& own : inner(section)) {
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

void interpolate(Section& section, int degree, int axes) {
    const InterpolationKind kind{degree};
    std::vector<double> entries(kind.band(section.points.size()).entries());
    BsplineInterpolation<double> system;
    require(system.prepare(kind, section.parameters, section.knots, entries, {}));
    section.controls.resize(section.points.size());
    require(system.interpolate(section.points, nullptr, axes, section.controls));
}

std::vector<Point<double>> refined(const Section& section, int degree, int axes, const std::vector<double>& merged) {
    std::vector<double> knots = section.knots;
    std::vector<Point<double>> controls = section.controls;
    knots.resize(merged.size());
    controls.resize(merged.size() - static_cast<std::size_t>(degree) - 1);
    GrowingCurve<double> curve{degree, axes, section.knots.size(), knots, controls};
    require(refine_knots<double>(curve, merged));
    return controls;
}

ordered_json list_json(const std::vector<Point<double>>& points, int axes) {
    ordered_json list = ordered_json::array();
    for (const Point<double>& point : points) {
        list.push_back(to_json(point, axes));
    }
    return list;
}

} // namespace

DescribedSurface describe_skin(const json& input) {
    DescribedSurface surface;
    std::vector<PointList> lists = read_sections(input, 2);
    const std::size_t count = lists.size();
    std::size_t fewest = lists.front().points.size();
    for (const PointList& list : lists) {
        fewest = std::min(fewest, list.points.size());
    }
    const int degree = surface.degree_u = degree_in(input, "degree_u", fewest, "points of the shortest section");
    surface.degree_v = degree_in(input, "degree_v", count, "sections");
    const double domain = number_in(input, "domain_length", 1.0);
    if (!(domain > 0.0)) {
        throw DescriptionError("\"domain_length\" must be greater than 0");
    }
    carry_along_spine(input, lists);
    surface.axes = lists.front().axes;

    std::vector<Section> sections(count);
    for (std::size_t s = 0; s < count; ++s) {
        Section& section = sections[s];
        section.points = Unit<double>(lists[s].largest(), 1.0).in(lists[s]);
        section.parameters.resize(section.points.size());
        section.knots.resize(open_knot_count(section.points.size(), degree));
        const Status status = spline_parameters<double>(section.points, surface.axes, Parameterization::chordal, false,
                                                        domain, section.parameters);
        if (status.error() == Error::coincident_points) {
            throw DescriptionError(
                fmt::format("\"sections\", section {}: two successive points are the same; leave one out", s + 1));
        }
        require(status);
        require(open_knots<double>(KnotRule::average, section.parameters, degree, false, section.knots));
    }
    surface.knots_u = merge_knots(sections, static_cast<std::size_t>(degree), domain);
    ordered_json section_knots = ordered_json::array();
    ordered_json section_controls = ordered_json::array();
    ordered_json refined_controls = ordered_json::array();
    const std::size_t along = surface.knots_u.size() - static_cast<std::size_t>(degree) - 1;
    surface.net.resize(along * count);
    for (std::size_t s = 0; s < count; ++s) {
        interpolate(sections[s], degree, surface.axes);
        section_knots.push_back(sections[s].knots);
        section_controls.push_back(list_json(sections[s].controls, surface.axes));
        const std::vector<Point<double>> controls = refined(sections[s], degree, surface.axes, surface.knots_u);
        refined_controls.push_back(list_json(controls, surface.axes));
        for (std::size_t j = 0; j < along; ++j) {
            surface.net[j * count + s] = controls[j];
        }
    }
    // Across: the columns share the means of their chord parameters.
    surface.params_v.resize(count);
    surface.knots_v.resize(open_knot_count(count, surface.degree_v));
    std::vector<Point<double>> row(std::max(along, count));
    std::vector<double> row_parameters(row.size());
    SurfaceStorage<double> storage;
    storage.row = row;
    storage.row_parameters = row_parameters;
    const Status status = grid_parameters<double>({surface.axes, along, count, surface.net}, SurfaceDirection::v,
                                                  Parameterization::chordal, 1.0, storage, surface.params_v);
    if (status.error() == Error::coincident_points) {
        throw DescriptionError("two successive sections of \"sections\" are the same; leave one out");
    }
    require(status);
    require(open_knots<double>(KnotRule::average, surface.params_v, surface.degree_v, false, surface.knots_v));
    const InterpolationKind kind{surface.degree_v};
    std::vector<double> entries(kind.band(count).entries());
    BsplineInterpolation<double> system;
    require(system.prepare(kind, surface.params_v, surface.knots_v, entries, {}));
    for (std::size_t j = 0; j < along; ++j) {
        require(system.solve(surface.net, surface.axes, j * count, 1));
    }
    surface.results["section_knots"] = section_knots;
    surface.results["section_control_points"] = section_controls;
    surface.results["merged_knots_u"] = surface.knots_u;
    surface.results["refined_control_points"] = refined_controls;
    return surface;
}

} // namespace splinefeed::host
