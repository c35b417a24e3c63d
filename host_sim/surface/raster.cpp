// SPDX-License-Identifier: MIT
#include "host_sim/surface/raster.hpp"

#include "host_sim/surface/span_places.hpp"
#include "host_sim/surface/vector.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::host {

namespace {

constexpr int most_raster_lines = 100000;
constexpr double most_waypoints = 1e8;
constexpr double same_point_mm = 1e-4; // as the core merges waypoints

double apart(const Vector& a, const Vector& b) {
    return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
}

bool same(const Vector& a, const Vector& b) {
    return std::max({std::fabs(a[0] - b[0]), std::fabs(a[1] - b[1]), std::fabs(a[2] - b[2])}) < same_point_mm;
}

Vector at(const ToolSurface& surface, const CellInterval& stretch, double t) {
    return stretch.kind == CellInterval::Kind::along ? surface.tool(t, stretch.constant)
                                                     : surface.tool(stretch.constant, t);
}

SurfaceDirection direction(const ToolSurface& surface, const CellInterval& stretch) {
    return stretch.kind == CellInterval::Kind::along ? surface.along() : surface.across();
}

// Parameters along a stretch so that neighbours are at most step_mm apart; those of creases are among them.
struct Places {
    std::vector<double> parameters;
    std::vector<bool> creases;
};

Places places_of(const ToolSurface& surface, const CellInterval& stretch) {
    const BSplineSurface<double>& view = surface.view();
    const SurfaceDirection along = direction(surface, stretch);
    const bool u = along == SurfaceDirection::u;
    const double low = std::min(stretch.from, stretch.to);
    const double high = std::max(stretch.from, stretch.to);
    std::vector<double> ends{low};
    for (const double crease : u ? creases(view.knots_u, view.degree_u) : creases(view.knots_v, view.degree_v)) {
        if (crease > low && crease < high) {
            ends.push_back(crease);
        }
    }
    ends.push_back(high);
    Places places{{low}, {false}};
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        // The length as of a polygon; a waypoint each step of it.
        const std::vector<double> fine = span_places(view, along, ends[i], ends[i + 1], 16, 256);
        std::vector<double> length{0.0};
        Vector before = at(surface, stretch, fine.front());
        for (std::size_t j = 1; j < fine.size(); ++j) {
            const Vector here = at(surface, stretch, fine[j]);
            length.push_back(length.back() + apart(before, here));
            before = here;
        }
        const double steps = std::ceil(length.back() * 1.001 / surface.options().step_mm);
        require_count(static_cast<double>(places.parameters.size()) + steps);
        const int count = std::max(1, static_cast<int>(steps));
        std::size_t slot = 0;
        for (int j = 1; j < count; ++j) {
            const double target = length.back() * j / count;
            while (length[slot + 1] < target) {
                ++slot;
            }
            const double part = (target - length[slot]) / (length[slot + 1] - length[slot]);
            places.parameters.push_back(fine[slot] + (fine[slot + 1] - fine[slot]) * part);
            places.creases.push_back(false);
        }
        places.parameters.push_back(ends[i + 1]);
        places.creases.push_back(i + 2 < ends.size());
    }
    if (stretch.from > stretch.to) {
        std::reverse(places.parameters.begin(), places.parameters.end());
        std::reverse(places.creases.begin(), places.creases.end());
    }
    return places;
}

void require_fit(const ToolSurface& surface, double along, double across) {
    const double r = surface.options().ball_radius_mm;
    const auto hollow = surface.hollow(along, across);
    if (hollow && *hollow * r > 1.0 + 1e-9) {
        const Vector p = surface.jet(along, across).position;
        throw DescriptionError("a ball of radius {:g} mm does not fit into the hollow at x={:.3f} y={:.3f} z={:.3f}, "
                               "whose radius is {:.4f} mm; take a smaller --ball-radius",
                               r, p[0], p[1], p[2], 1.0 / *hollow);
    }
}

// In every knot span, as a hollow may be narrower than a step, and at every place the path will have.
// Returns how many the latter are.
std::size_t require_fit(const ToolSurface& surface, const CellInterval& stretch) {
    std::vector<double> looks = places_of(surface, stretch).parameters;
    const std::size_t count = looks.size();
    const auto [low, high] = std::minmax(stretch.from, stretch.to);
    const std::vector<double> within = span_places(surface.view(), direction(surface, stretch), low, high, 8, 48);
    looks.insert(looks.end(), within.begin(), within.end());
    for (const double t : looks) {
        const bool along = stretch.kind == CellInterval::Kind::along;
        require_fit(surface, along ? t : stretch.constant, along ? stretch.constant : t);
    }
    return count;
}

} // namespace

void require_count(double count) {
    if (!(count <= most_waypoints)) { // not a number, too
        throw DescriptionError("the path needs more than {:.0f} waypoints; take a larger --step, or fewer lines",
                               most_waypoints);
    }
}

std::vector<double> line_parameters(const ToolSurface& surface) {
    const double first = surface.first_across();
    const double last = surface.last_across();
    std::vector<double> lines;
    if (surface.options().lines) {
        const int count = *surface.options().lines;
        for (int i = 0; i < count; ++i) {
            lines.push_back(i + 1 == count ? last : first + (last - first) * i / (count - 1));
        }
        return lines;
    }
    const double highest = surface.options().scallop_mm.value_or(0.0);
    lines.push_back(first);
    double step = (last - first) / 64.0;
    while (lines.back() < last) {
        const double from = lines.back();
        double bad = last - from;
        if ((lines.size() == 1 || bad < 4.0 * step) && surface.scallop_mm(from, last, highest) <= highest) {
            lines.push_back(last);
            break;
        }
        step = std::min(step, bad / 2.0);
        double ridge = surface.scallop_mm(from, from + step, highest);
        while (ridge > highest && step > 1e-12 * (last - first)) {
            bad = step;
            step /= 2.0;
            ridge = surface.scallop_mm(from, from + step, highest);
        }
        // The ridge grows about as the square of the step: aimed for a little below, halved where that fails.
        for (int tries = 0; tries < 40 && bad - step > 1e-3 * step && ridge < 0.995 * highest; ++tries) {
            const double aimed = step * std::min(2.0, std::sqrt(0.998 * highest / std::max(ridge, 1e-300)));
            const double next = aimed > step && aimed < bad ? aimed : 0.5 * (step + bad);
            const double height = surface.scallop_mm(from, from + next, highest);
            if (height <= highest) {
                step = next;
                ridge = height;
            } else {
                bad = next;
            }
        }
        lines.push_back(from + step);
        if (lines.size() > most_raster_lines) {
            throw DescriptionError("ridges of {:g} mm need more than {} lines; take a larger --scallop", highest,
                                   most_raster_lines);
        }
    }
    return lines;
}

std::vector<CellInterval> raster(const ToolSurface& surface) {
    using Kind = CellInterval::Kind;
    const std::vector<double> lines = line_parameters(surface);
    const double first = surface.first_along();
    const double last = surface.last_along();
    const double way_back = surface.highest_mm() + surface.options().lift_mm;
    std::vector<CellInterval> path;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const bool back = surface.options().zigzag && i % 2 == 1;
        const double from = back ? last : first;
        const double to = back ? first : last;
        path.push_back({Kind::along, lines[i], from, to, {}, {}});
        if (i + 1 == lines.size()) {
            break;
        }
        if (surface.options().zigzag) {
            path.push_back({Kind::across, to, lines[i], lines[i + 1], {}, {}});
            continue;
        }
        const Vector end = surface.tool(to, lines[i]);
        const Vector next = surface.tool(from, lines[i + 1]);
        Vector up = end;
        Vector over = next;
        up[2] = over[2] = way_back;
        path.push_back({Kind::straight, 0.0, 0.0, 0.0, end, up});
        path.push_back({Kind::straight, 0.0, 0.0, 0.0, up, over});
        path.push_back({Kind::straight, 0.0, 0.0, 0.0, over, next});
    }
    double count = 0.0;
    for (const CellInterval& stretch : path) {
        if (surface.options().ball_radius_mm > 0.0 && stretch.kind != CellInterval::Kind::straight) {
            count += static_cast<double>(require_fit(surface, stretch));
            require_count(count);
        }
    }
    return path;
}

std::vector<double> stretch_parameters(const ToolSurface& surface, const CellInterval& stretch) {
    return places_of(surface, stretch).parameters;
}

std::vector<ToolPoint> waypoints(const ToolSurface& surface, const std::vector<CellInterval>& path) {
    std::vector<ToolPoint> points;
    const auto add = [&points](const Vector& position, bool corner) {
        if (!points.empty() && same(points.back().position, position)) {
            points.back().corner = points.back().corner || corner;
        } else {
            points.push_back({position, corner});
        }
    };
    for (const CellInterval& stretch : path) {
        if (stretch.kind == CellInterval::Kind::straight) {
            add(stretch.start, true);
            add(stretch.end, true);
            continue;
        }
        const Places places = places_of(surface, stretch);
        require_count(static_cast<double>(points.size() + places.parameters.size()));
        for (std::size_t i = 0; i < places.parameters.size(); ++i) {
            const bool end = i == 0 || i + 1 == places.parameters.size();
            add(at(surface, stretch, places.parameters[i]), end || places.creases[i]);
        }
    }
    return points;
}

} // namespace splinefeed::host
