// SPDX-License-Identifier: MIT
#include "path_limits.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

constexpr double tolerance_mm = 1e-6;
constexpr double most_counts = 2147483647.0;
constexpr double slack_mm = 1e-9; // rounding of points up to 2^20 mm
constexpr int deepest = 24;       // halvings; a hull is 4^-24 of its segment's wide then

using Points = PerDegree<double>;

struct Extent {
    double low;
    double high;
};

Extent hull(const Points& points, unsigned degree) {
    const auto [low, high] = std::minmax_element(points.begin(), points.begin() + degree + 1);
    return {*low, *high};
}

// Adds to `found` the points of the curve that are needed to know how far it goes beyond the limits.
void survey(const Points& points, unsigned degree, Extent limits, int depth, Extent& found) {
    const auto take = [&found](double value) {
        found.low = std::min(found.low, value);
        found.high = std::max(found.high, value);
    };
    take(points[0]);
    take(points[degree]);
    const Extent most = hull(points, degree);
    // Nothing below adds to what is known.
    if (most.high <= std::max(limits.high, found.high) + slack_mm &&
        most.low >= std::min(limits.low, found.low) - slack_mm) {
        return;
    }
    if (depth == deepest) {
        return;
    }
    Points left{};
    Points right = points;
    left[0] = points[0];
    for (unsigned step = 1; step <= degree; ++step) {
        for (unsigned i = 0; i + step <= degree; ++i) {
            right[i] = (right[i] + right[i + 1]) / 2.0;
        }
        left[step] = right[0];
    }
    survey(left, degree, limits, depth + 1, found);
    survey(right, degree, limits, depth + 1, found);
}

} // namespace

PathLimits::PathLimits(const MachineDescription& machine) : axes_(machine.settings.axes) {
    for (unsigned k = 0; k < static_cast<unsigned>(axes_); ++k) {
        const double reach = most_counts / machine.settings.axis[k].steps_per_mm;
        const Travel travel = machine.travel[k].value_or(Travel{-reach, reach});
        axis_[k] = {machine.axis_name[k], travel.low, travel.high, machine.travel[k].has_value()};
    }
}

template <Scalar S>
std::optional<std::string> PathLimits::violation(const CurveSegment<S>& segment) const {
    const auto degree = static_cast<unsigned>(segment.degree);
    for (unsigned k = 0; k < static_cast<unsigned>(axes_); ++k) {
        const Axis& axis = axis_[k];
        Points points{};
        for (unsigned i = 0; i <= degree; ++i) {
            points[i] = segment.control_mm(static_cast<int>(k), static_cast<int>(i));
        }
        const Extent limits{axis.low - tolerance_mm, axis.high + tolerance_mm};
        Extent found{points[0], points[0]};
        survey(points, degree, limits, 0, found);
        if (found.low >= limits.low && found.high <= limits.high) {
            continue;
        }
        const double value = found.low < limits.low ? found.low : found.high;
        if (axis.travel) {
            return fmt::format("axis {} goes to {:.6f} mm; its travel_mm is [{}, {}]", axis.name, value, axis.low,
                               axis.high);
        }
        return fmt::format(
            "axis {} goes to {:.6f} mm; with its steps_per_mm it must stay within +-{:.6f} mm, 2147483647 counts",
            axis.name, value, axis.high);
    }
    return std::nullopt;
}

template std::optional<std::string> PathLimits::violation(const CurveSegment<double>&) const;
template std::optional<std::string> PathLimits::violation(const CurveSegment<float>&) const;
template std::optional<std::string> PathLimits::violation(const CurveSegment<Fixed>&) const;

} // namespace splinefeed::host
