// SPDX-License-Identifier: MIT
//
// dq/ds of a cell is the cubic with the Bezier points of acceleration_bound.cpp. The length of a vector is convex: the
// length of the linear axes' part is nowhere larger than at the longest of the four points.
#include "splinefeed/s3_feed_plan/limits/feed_share.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"

namespace splinefeed {

namespace {

template <Scalar S>
Ratio<S> share_of(const Cell<S>& cell, const MotionLimits<S>& limits, bool rotary) noexcept {
    const auto sixth = literal<Ratio<S>>(1.0 / 6.0);
    Ratio<S> largest{};
    for (unsigned j = 0; j < 4; ++j) {
        PerAxis<Ratio<S>> direction{};
        for (const unsigned k : indices(cell.axes)) {
            const AxisShape<S>& shape = cell.shape[k];
            if (limits.rotary[k] == rotary) {
                direction[k] = j == 0   ? shape.tangent[0]
                               : j == 1 ? shape.tangent[0] + sixth * shape.bend[0]
                               : j == 2 ? shape.tangent[1] - sixth * shape.bend[2]
                                        : shape.tangent[1];
            }
        }
        largest = larger(largest, norm(direction, cell.axes));
    }
    return smaller(largest, from_integer<Ratio<S>>(1));
}

// Below, a linear axis does not count as moving. Lines of such shares come with Cell::feed_along_path.
template <Scalar S>
constexpr auto least_linear = literal<Ratio<S>>(0x1p-17);

} // namespace

template <Scalar S>
S feed_share(const Cell<S>& cell, const MotionLimits<S>& limits) noexcept {
    if (!limits.mixed || cell.feed_along_path) {
        return from_integer<S>(1);
    }
    const Ratio<S> linear = share_of(cell, limits, false);
    return lengthened<S>(linear > least_linear<S> ? linear : share_of(cell, limits, true));
}

template <Scalar S>
bool feed_is_linear(const Cell<S>& cell, const MotionLimits<S>& limits) noexcept {
    return !limits.mixed || (!cell.feed_along_path && share_of(cell, limits, false) > least_linear<S>);
}

#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template S feed_share(const Cell<S>&, const MotionLimits<S>&) noexcept;                                            \
    template bool feed_is_linear(const Cell<S>&, const MotionLimits<S>&) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
