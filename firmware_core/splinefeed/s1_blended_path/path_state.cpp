// SPDX-License-Identifier: MIT
#include "splinefeed/s1_blended_path/path_state.hpp"

#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

template <Scalar S>
void quintic_between(const PathState<S>& from, const PathState<S>& to, const Handles<S>& begin, const Handles<S>& end,
                     int axes, PerAxis<PerDegree<S>>& points) noexcept {
    for (const unsigned k : indices(axes)) {
        PerDegree<S>& b = points[k];
        // first^2 K in two steps: first |K| is at most 1, so neither product leaves the range of Fixed.
        const S turn_from = scale2(begin.first * from.bend[k], -bend_log2);
        const S turn_to = scale2(end.first * to.bend[k], -bend_log2);
        b[0] = from.offset[k];
        b[1] = from.offset[k] + begin.first * from.tangent[k];
        b[2] = from.offset[k] + begin.second * from.tangent[k] + literal<S>(1.25) * (begin.first * turn_from);
        b[3] = to.offset[k] - end.second * to.tangent[k] + literal<S>(1.25) * (end.first * turn_to);
        b[4] = to.offset[k] - end.first * to.tangent[k];
        b[5] = to.offset[k];
    }
}

template <Scalar S>
void quintic_between(const PathState<S>& from, const PathState<S>& to, S first, S second, int axes,
                     PerAxis<PerDegree<S>>& points) noexcept {
    quintic_between(from, to, {first, second}, {first, second}, axes, points);
}

#if SPLINEFEED_MAX_DEGREE >= 5
#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template void quintic_between(const PathState<S>&, const PathState<S>&, S, S, int,                                 \
                                  PerAxis<PerDegree<S>>&) noexcept;                                                    \
    template void quintic_between(const PathState<S>&, const PathState<S>&, const Handles<S>&, const Handles<S>&, int, \
                                  PerAxis<PerDegree<S>>&) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE
#endif

} // namespace splinefeed
