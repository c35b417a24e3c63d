// SPDX-License-Identifier: MIT
//
// Double reflection: the frame at x_i is reflected in the plane that halves x_i x_{i+1}, which gives a left-handed
// frame with tangent t_L, and that one in the plane that halves the tips of t_L and t_{i+1}. Two reflections are a
// rotation; it turns about the tangent by an error of fourth order in the step only.
#include "host_sim/surface/spine.hpp"

#include "host_sim/surface/vector.hpp"

#include "splinefeed/splines/bspline_basis.hpp"
#include "splinefeed/splines/bspline_interpolation.hpp"
#include "splinefeed/splines/spline_parameters.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::host {

namespace {

using nlohmann::json;

constexpr int steps_between_stations = 64;

Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector unit(const Vector& a) {
    return plus({}, 1.0 / std::sqrt(dot(a, a)), a);
}

// a mirrored in the plane through 0 across `axis`.
Vector reflected(const Vector& a, const Vector& axis) {
    const double size_sq = dot(axis, axis);
    return size_sq > 0.0 ? plus(a, -2.0 * dot(axis, a) / size_sq, axis) : a;
}

/// The spine as a B-spline curve over [0, 1].
struct Spine {
    int degree = 3;
    std::vector<double> knots;
    std::vector<Point<double>> controls;

    [[nodiscard]] Frame at(double t) const {
        const CurveJet<double> jet = bspline_curve<double>(knots, degree, controls, 3, t);
        Frame frame;
        frame.origin = jet.position;
        if (!(dot(jet.first, jet.first) > 0.0)) {
            throw DescriptionError("\"spine\" has no direction at {:.6g} of its length; move its points", t);
        }
        frame.tangent = unit(jet.first);
        return frame;
    }
};

Spine read_spine(const json& description) {
    const PointList list = points_in(description, "points", 2);
    if (list.axes != 3) {
        throw DescriptionError("\"spine\" has points of {} numbers; they must have 3", list.axes);
    }
    Spine spine;
    const std::vector<Point<double>> points = Unit<double>(list.largest(), 1.0).in(list);
    spine.degree = static_cast<int>(std::min<std::size_t>(3, points.size() - 1));
    const InterpolationKind kind{spine.degree};
    std::vector<double> parameters(points.size());
    spine.knots.resize(kind.knots(points.size()));
    spine.controls.resize(points.size());
    std::vector<double> entries(kind.band(points.size()).entries());
    const Status status = spline_parameters<double>(points, 3, Parameterization::chordal, false, 1.0, parameters);
    if (status.error() == Error::coincident_points) {
        throw DescriptionError("\"spine\": two successive points are the same; leave one out");
    }
    require(status);
    require(open_knots<double>(KnotRule::average, parameters, spine.degree, false, spine.knots));
    BsplineInterpolation<double> system;
    require(system.prepare(kind, parameters, spine.knots, entries, {}));
    require(system.interpolate(points, nullptr, 3, spine.controls));
    return spine;
}

std::vector<double> read_stations(const json& description, std::size_t count) {
    const auto given = description.find("stations");
    std::vector<double> stations;
    for (std::size_t i = 0; i < count; ++i) {
        stations.push_back(static_cast<double>(i) / static_cast<double>(count - 1));
    }
    if (given != description.end() && !given->is_null()) {
        if (!given->is_array() || given->size() != count) {
            throw DescriptionError("\"stations\" must be an array of {} numbers, one a section", count);
        }
        stations = numbers_in(description, "stations", count, 0.0);
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (stations[i] < 0.0 || stations[i] > 1.0 || (i > 0 && !(stations[i] > stations[i - 1]))) {
            throw DescriptionError("\"stations\", number {} is {:.6g}; they must rise from 0 to 1 at most", i + 1,
                                   stations[i]);
        }
    }
    return stations;
}

// A unit vector at right angles to the tangent.
Vector first_normal(const json& description, const Vector& tangent) {
    Vector wish{};
    if (!vector_in(description, "normal", 3, wish)) {
        std::size_t across = 0;
        for (std::size_t k = 1; k < 3; ++k) {
            across = std::fabs(tangent[k]) < std::fabs(tangent[across]) ? k : across;
        }
        wish[across] = 1.0;
    }
    const Vector normal = plus(wish, -dot(wish, tangent), tangent);
    if (!(dot(normal, normal) > 1e-12 * dot(wish, wish))) {
        throw DescriptionError("\"normal\" must not be zero, nor point along the spine");
    }
    return unit(normal);
}

} // namespace

void turn_least(std::vector<Frame>& frames) {
    frames[0].binormal = cross(frames[0].tangent, frames[0].normal);
    for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
        const Vector step = plus(frames[i + 1].origin, -1.0, frames[i].origin);
        const Vector normal = reflected(frames[i].normal, step);
        const Vector tangent = reflected(frames[i].tangent, step);
        const Vector second = plus(frames[i + 1].tangent, -1.0, tangent);
        // Rounding does not add up: at right angles and of length 1 each time.
        const Vector turned = reflected(normal, second);
        frames[i + 1].normal = unit(plus(turned, -dot(turned, frames[i + 1].tangent), frames[i + 1].tangent));
        frames[i + 1].binormal = cross(frames[i + 1].tangent, frames[i + 1].normal);
    }
}

void carry_along_spine(const json& input, std::vector<PointList>& sections) {
    const auto description = input.find("spine");
    if (description == input.end() || description->is_null()) {
        return;
    }
    if (!description->is_object()) {
        throw DescriptionError("\"spine\" must be an object with \"points\"");
    }
    require_known(*description, {"points", "stations", "normal"}, "\"spine\"");
    if (sections.front().axes != 2 && sections.front().axes != 3) {
        throw DescriptionError("sections on a spine must have points of 2 or 3 numbers");
    }
    const Spine spine = read_spine(*description);
    const std::vector<double> stations = read_stations(*description, sections.size());
    std::vector<Frame> frames{spine.at(stations[0])};
    for (std::size_t i = 1; i < stations.size(); ++i) {
        for (int step = 1; step <= steps_between_stations; ++step) {
            const double fraction = static_cast<double>(step) / steps_between_stations;
            frames.push_back(spine.at(stations[i - 1] + fraction * (stations[i] - stations[i - 1])));
        }
    }
    frames[0].normal = first_normal(*description, frames[0].tangent);
    turn_least(frames);
    for (std::size_t s = 0; s < sections.size(); ++s) {
        const Frame& frame = frames[s * steps_between_stations];
        for (PerAxis<double>& point : sections[s].points) {
            const Vector across = plus(plus(frame.origin, point[0], frame.normal), point[1], frame.binormal);
            point = plus(across, point[2], frame.tangent);
        }
        sections[s].axes = 3;
    }
}

} // namespace splinefeed::host
