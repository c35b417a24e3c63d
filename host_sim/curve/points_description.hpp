// SPDX-License-Identifier: MIT
// points_description: makes a curve description from waypoints and the options of the command line.
#pragma once

#include "host_sim/curve/curve_choice.hpp"

#include <nlohmann/json.hpp>
#include <vector>

namespace splinefeed::host {

/// The "input" for the method of `choice`, as describe_curve takes it. Throws DescriptionError if the points are not
/// enough for the method.
/// @param axes  numbers per point
[[nodiscard]] nlohmann::json points_description(const CurveChoice& choice, const std::vector<PerAxis<double>>& points,
                                                int axes);

/// The name of its method in descriptions.
[[nodiscard]] std::string_view description_name(Method method) noexcept;

} // namespace splinefeed::host
