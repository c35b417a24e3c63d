// SPDX-License-Identifier: MIT
//
// With |dq/ds| <= t over the length L, an axis that goes from q0 to q1 stays within (q0 + q1) / 2 +- t L / 2.
#include "splinefeed/s3_feed_plan/limits/axis_velocity.hpp"

#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

template <Scalar S>
S axis_velocity(const Cell<S>& cell, const MotionLimits<S>& limits, unsigned axis) noexcept {
    const S velocity = limits.velocity_mm_s[axis];
    const S at_end = limits.end_velocity_mm_s[axis];
    if (!(at_end > S{}) || !(at_end < velocity)) {
        return velocity;
    }
    S moved{};
    for (unsigned i = 1; i <= static_cast<unsigned>(cell.degree); ++i) {
        moved += cell.power[axis][i];
    }
    const Position middle = displaced(cell.origin[axis], cell.power[axis][0] + scale2(moved, -1), cell.unit_log2);
    const S reach = half(cell.length_mm * cell.tangent_max[axis]);
    const PositionRange& open = limits.refinement.open[axis];
    const bool inside =
        displaced(middle, -reach, 0).raw >= open.low.raw && displaced(middle, reach, 0).raw <= open.high.raw;
    return inside ? velocity : at_end;
}

#define SPLINEFEED_INSTANTIATE(S) template S axis_velocity(const Cell<S>&, const MotionLimits<S>&, unsigned) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
