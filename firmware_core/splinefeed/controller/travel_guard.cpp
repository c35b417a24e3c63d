// SPDX-License-Identifier: MIT
#include "splinefeed/controller/travel_guard.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/splines/curve_hull.hpp"

namespace splinefeed {

template <Scalar S>
bool TravelGuard<S>::leaves(const CurveSegment<S>& segment) const noexcept {
    for (const unsigned k : indices(axes_)) {
        const AxisTravel& travel = (*travel_)[k];
        if (!travel.limited) {
            continue;
        }
        const int unit = segment.unit_log2;
        // No point of a segment is as far away; where it is short, an end of travel is further than a number goes.
        const S far = literal<S>(1e6);
        const S low = distance<S>(segment.origin[k], to_position(travel.low - AxisTravel::allowance), unit);
        const S high = distance<S>(segment.origin[k], to_position(travel.high + AxisTravel::allowance), unit);
        const Extent<S> allowed{larger(low, -far), smaller(high, far)};
        const S slack = scale2(literal<S>(1e-6), -unit);
        if (!allowed.contains(extent_beyond(segment.control[k], segment.degree, allowed, slack))) {
            return true;
        }
    }
    return false;
}

template <Scalar S>
Pull TravelGuard<S>::next(CurveSegment<S>& out) noexcept {
    if (ended_) {
        return Pull::starved;
    }
    const Pull pull = source_->next(out);
    ended_ = pull == Pull::item && leaves(out);
    return ended_ ? Pull::starved : pull;
}

#if SPLINEFEED_MAX_DEGREE >= 5
SPLINEFEED_INSTANTIATE_CLASS(TravelGuard)
#endif

} // namespace splinefeed
