// SPDX-License-Identifier: MIT
// points_input: what the "input" of a description says of waypoints and tangents that came another way.
#pragma once

#include "host_sim/curve/methods/curve_choice.hpp"

#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace splinefeed::host {

/// `count` points from `first` on, each with `axes` numbers.
[[nodiscard]] nlohmann::json points_json(const std::vector<PerAxis<double>>& points, std::size_t first,
                                         std::size_t count, int axes);
/// null where there is none.
[[nodiscard]] nlohmann::json tangent_json(const std::optional<Tangent>& tangent, int axes);

} // namespace splinefeed::host
