// SPDX-License-Identifier: MIT
//
// A segment averages the plan over three durations T. Within these an axis must not brake with the limit for
// acceleration; if it turns round in that time, it must use the smaller limit for both. Let A be the larger limit. An
// axis that stands within 4 T is then at most A (4 T)^2 / 2 away from that place, and the same holds after standstill.
// So a cell keeps its heading if the axis travels 8 A T^2 between the cell and the next place where it may turn round,
// on either side. A cell at a stop after which the axis returns in the direction from which it came has no heading.
#include "splinefeed/s3_feed_plan/acceleration/turning.hpp"

#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

namespace {

// The smallest |q'| in a cell, with its sign; 0 if q' may vanish.
template <Scalar S>
Ratio<S> least_tangent(const Cell<S>& cell, unsigned axis) noexcept {
    using R = Ratio<S>;
    if ((cell.length_mm + cell.length_mm) * cell.curvature_max[axis] > literal<S>(Cell<S>::sharp_turn)) {
        return {}; // the shape has no sign
    }
    const AxisShape<S>& shape = cell.shape[axis];
    const R sixth = literal<R>(1.0 / 6.0);
    const R t1 = shape.tangent[0] + sixth * shape.bend[0];
    const R t2 = shape.tangent[1] - sixth * shape.bend[2];
    const R lowest = smaller(smaller(shape.tangent[0], shape.tangent[1]), smaller(t1, t2)) - shape.error_bound;
    const R highest = larger(larger(shape.tangent[0], shape.tangent[1]), larger(t1, t2)) + shape.error_bound;
    return lowest > R{} ? lowest : highest < R{} ? highest : R{};
}

} // namespace

template <Scalar S>
S Turning<S>::near_mm_of(unsigned axis) const noexcept {
    const S speeding = limits_->acceleration_mm_s2[axis];
    const S braking = limits_->braking_mm_s2[axis];
    return speeding == braking
               ? S{}
               : scale2(larger(speeding, braking) / limits_->segments_per_s / limits_->segments_per_s, 3);
}

template <Scalar S>
void Turning<S>::clear() noexcept {
    for (const unsigned k : indices(limits_->axes)) {
        travelled_mm_[k] = near_mm_of(k); // the axis stood
    }
    way_ = {};
}

template <Scalar S>
int Turning<S>::way_in(const Cell<S>& cell, unsigned axis) noexcept {
    const Ratio<S> least = least_tangent(cell, axis);
    return least > Ratio<S>{} ? 1 : least < Ratio<S>{} ? -1 : 0;
}

template <Scalar S>
S Turning<S>::travel_in(const Cell<S>& cell, unsigned axis) noexcept {
    return cell.length_mm * absolute(least_tangent(cell, axis));
}

SPLINEFEED_INSTANTIATE_CLASS(Turning)

} // namespace splinefeed
