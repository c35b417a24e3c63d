// SPDX-License-Identifier: MIT
#include "splinefeed/splines/point_list.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"

namespace splinefeed {

template <Scalar S>
std::size_t first_bad_point(std::span<const Point<S>> points) noexcept {
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (const S& x : points[i]) {
            if (!within(x, farthest_coordinate<S>())) {
                return i;
            }
        }
    }
    return points.size();
}

template <Scalar S>
std::size_t closed_count(std::span<const Point<S>> points) noexcept {
    const bool repeated = points.size() > 1 && points.front() == points.back();
    return points.size() - (repeated ? 1U : 0U);
}

template <Scalar S>
Point<S> chord_between(const Point<S>& from, const Point<S>& to) noexcept {
    return difference(to, from, max_axes);
}

#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template std::size_t first_bad_point<S>(std::span<const Point<S>>) noexcept;                                       \
    template std::size_t closed_count<S>(std::span<const Point<S>>) noexcept;                                          \
    template Point<S> chord_between<S>(const Point<S>&, const Point<S>&) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
