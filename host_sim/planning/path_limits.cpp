// SPDX-License-Identifier: MIT
#include "host_sim/planning/path_limits.hpp"

#include "splinefeed/number/vector.hpp"
#include "splinefeed/splines/curve_hull.hpp"

#include <fmt/format.h>

namespace splinefeed::host {

namespace {

constexpr double counter_limit = 2147483647.0;
constexpr double slack_mm = 1e-9; // rounding of points up to 2^20 mm

} // namespace

PathLimits::PathLimits(const MachineDescription& machine) : axes_(machine.settings.axes) {
    for (const unsigned k : indices(axes_)) {
        const double reach = counter_limit / machine.settings.axis[k].steps_per_mm;
        const Travel travel = machine.travel[k].value_or(Travel{-reach, reach});
        const char* const unit = machine.settings.axis[k].rotary ? "degrees" : "mm";
        axis_[k] = {machine.axis_name[k], unit, travel.low, travel.high, machine.travel[k].has_value()};
    }
}

bool PathLimits::contain(const PerAxis<double>& low, const PerAxis<double>& high, double margin) const noexcept {
    return for_all(axes_,
                   [&](unsigned k) { return low[k] - margin >= axis_[k].low && high[k] + margin <= axis_[k].high; });
}

std::optional<std::string> PathLimits::violation(const CurveSegment<double>& segment) const {
    const auto degree = static_cast<unsigned>(segment.degree);
    for (const unsigned k : indices(axes_)) {
        const Axis& axis = axis_[k];
        PerDegree<double> points{};
        for (unsigned i = 0; i <= degree; ++i) {
            points[i] = segment.control_mm(static_cast<int>(k), static_cast<int>(i));
        }
        const Extent<double> limits{axis.low - travel_allowance_mm, axis.high + travel_allowance_mm};
        const Extent<double> found = extent_beyond(points, segment.degree, limits, slack_mm);
        if (limits.contains(found)) {
            continue;
        }
        const double value = found.low < limits.low ? found.low : found.high;
        if (axis.travel) {
            return fmt::format("axis {} goes to {:.6f} {}; its travel_mm is [{}, {}]", axis.name, value, axis.unit,
                               axis.low, axis.high);
        }
        return fmt::format(
            "axis {} goes to {:.6f} {}; with its steps_per_mm it must stay within +-{:.6f} {}, 2147483647 counts",
            axis.name, value, axis.unit, axis.high, axis.unit);
    }
    return std::nullopt;
}

} // namespace splinefeed::host
