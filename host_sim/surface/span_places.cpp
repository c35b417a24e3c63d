// SPDX-License-Identifier: MIT
#include "host_sim/surface/span_places.hpp"

#include <algorithm>

namespace splinefeed::host {

std::vector<double> span_places(const BSplineSurface<double>& surface, SurfaceDirection along, double low, double high,
                                int parts, int total) {
    std::vector<double> ends{low};
    for (const double knot : along == SurfaceDirection::u ? surface.knots_u : surface.knots_v) {
        if (knot > ends.back() && knot < high) {
            ends.push_back(knot);
        }
    }
    ends.push_back(high);
    const int spans = static_cast<int>(ends.size()) - 1;
    const int cuts = std::max(parts, (total + spans - 1) / spans);
    std::vector<double> places;
    places.reserve(static_cast<std::size_t>(cuts) * (ends.size() - 1) + 1);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        for (int j = 0; j < cuts; ++j) {
            places.push_back(ends[i] + (ends[i + 1] - ends[i]) * j / cuts);
        }
    }
    places.push_back(high);
    return places;
}

} // namespace splinefeed::host
