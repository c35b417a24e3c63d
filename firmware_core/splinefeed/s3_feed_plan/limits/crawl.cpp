// SPDX-License-Identifier: MIT
//
// No axis is faster than the speed v along the path. So the differences of its samples, T apart, are at most v T, their
// differences 2 v T and the third ones 4 v T. With v = way / (n T) and n ticks
//
//   2 way / n <= A T^2,     4 way / n <= J T^3.
//
// MotionLimits::make refuses machines for which the rounding of positions, at least 1e-9 mm, is a quarter of either
// limit: so n is below 1000.
#include "splinefeed/s3_feed_plan/limits/crawl.hpp"

#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

template <Scalar S>
S crawling_ticks(S way_mm, const MotionLimits<S>& limits) noexcept {
    const S per_s = limits.segments_per_s;
    const S second = scale2(way_mm, 1) * per_s;
    const S third = scale2(way_mm, 2) * per_s * per_s;
    S seconds{};
    for (const unsigned k : indices(limits.axes)) {
        const S acceleration = smaller(limits.acceleration_mm_s2[k], limits.braking_mm_s2[k]);
        seconds = larger(seconds,
                         larger(quotient_or_max(second, acceleration), quotient_or_max(third, limits.jerk_mm_s3[k])));
    }
    return larger(seconds * per_s, from_integer<S>(1));
}

#define SPLINEFEED_INSTANTIATE(S) template S crawling_ticks(S, const MotionLimits<S>&) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
