// SPDX-License-Identifier: MIT
#include "host_sim/curve/methods/points_input.hpp"

#include <nlohmann/json.hpp>

namespace splinefeed::host {

using nlohmann::json;

namespace {

json point_json(const PerAxis<double>& point, int axes) {
    json array = json::array();
    for (const unsigned k : indices(axes)) {
        array.push_back(point[k]);
    }
    return array;
}

} // namespace

json points_json(const std::vector<PerAxis<double>>& points, std::size_t first, std::size_t count, int axes) {
    json array = json::array();
    for (std::size_t i = first; i < first + count; ++i) {
        array.push_back(point_json(points[i], axes));
    }
    return array;
}

json tangent_json(const std::optional<Tangent>& tangent, int axes) {
    return tangent ? point_json(tangent->value, axes) : json(nullptr);
}

} // namespace splinefeed::host
